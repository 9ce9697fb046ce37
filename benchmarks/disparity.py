#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Disparities against the truth, as matched and refined.

usage: disparity.py BIN PAIR...

A PAIR is a folder with im0.png, im1.png, calib.txt, disp0.pfm and perhaps
mask0nocc.png (Middlebury), or with rect_left.png, rect_right.png, calib_rect.yml,
rect_disp0.pfm and rect_mask.png (rendered; the object's pixels count). Errors are taken
where both cameras see, if the folder says where that is; the time is that of matching and
refining the whole image.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image


def read_pfm(path):
    with open(path, "rb") as f:
        f.readline()
        width, height = map(int, f.readline().split())
        kind = "<f4" if float(f.readline()) < 0 else ">f4"
        return np.flipud(np.frombuffer(f.read(), kind).reshape(height, width))


def measure(program, pair, matcher, refine, out):
    rendered = (pair / "rect_left.png").exists()
    names = (("rect_left.png", "rect_right.png", "calib_rect.yml", "rect_disp0.pfm",
              "rect_mask.png") if rendered else
             ("im0.png", "im1.png", "calib.txt", "disp0.pfm", "mask0nocc.png"))
    left, right, calib, truth, mask = (pair / name for name in names)
    disparity, model = out / "disparity.pfm", out / "model.json"
    for old in (disparity, model):
        old.unlink(missing_ok=True)
    truth = read_pfm(truth)
    known = np.isfinite(truth) & (truth > 0)
    if mask.exists():
        known &= np.asarray(Image.open(mask).convert("L")) == 255
    height, width = truth.shape
    # the model is of no interest here; a box in the middle asks for no segmentation
    run = subprocess.run(
        [program, left, right, "--calib", calib, "--matcher", matcher,
         "--refine" if refine else "--no-refine", "--max-parts", "1", "--roi",
         f"{width // 4},{height // 4},{width // 2},{height // 2}", "--segment", "none",
         "--disparity", disparity, "--output", model, "--quiet"],
        capture_output=True, text=True)
    if not disparity.exists():
        sys.exit(run.stderr)
    found = read_pfm(disparity)
    matched = known & np.isfinite(found)
    error = np.abs(found - truth)[matched]
    time = (json.loads(model.read_text())["timings_ms"]["match"] if model.exists()
            else float("nan"))
    return (np.median(error), 100 * np.mean(error > 1), 100 * np.mean(error > 2),
            100 * matched.sum() / known.sum(), time)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program = pathlib.Path(sys.argv[1]) / "pcl_sq_stereo"
    print("| pair | matcher | refined | median [px] | > 1 px | > 2 px | coverage | ms |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as out:
        for pair in map(pathlib.Path, sys.argv[2:]):
            for matcher in ("bm", "sgbm"):
                for refine in (False, True):
                    row = measure(program, pair, matcher, refine, pathlib.Path(out))
                    print("| %s | %s | %s | %.3f | %.1f %% | %.1f %% | %.0f %% | %.0f |" % (
                        pair.name, matcher.upper(), "yes" if refine else "no", *row),
                        flush=True)


if __name__ == "__main__":
    main()
