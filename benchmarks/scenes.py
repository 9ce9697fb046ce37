#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Things told apart: pcl_sq_scene on real tables whose pixels were labelled by hand.

usage: scenes.py BIN CASE... [--out DIR] [--json OUT] [-- OPTION...]

BIN holds pcl_sq_scene, which gets the given OPTIONs. A CASE is
  an organized PCD file with a field "label": 20 to 29 is the first thing, 30 to 39 the
  second, and so on (mOSD)
  a folder with color.png, depth_1mm.png or depth_0.1mm.png, labels.png, and
  camera_and_roi.csv: fx, fy, cx, cy, and of each thing object, label and, where known,
  top_above_table_mm

One line a case and one for all:
  things  that are labelled, of 150 pixels or more
  own     share of them with a piece of their own: intersection over union of .75 or more
  mean    intersection over union of the best piece
  merged  pieces that hold more than half of two things or more
  extra   pieces that are mostly no thing, or a part of one less than half
  height  largest error of the height above the table, of those with a piece of their own
          [mm, and % of the height]
  ms      of the scene without reading it
--out keeps panels and scene files. Exit code 1 where a program fails.
"""
import argparse
import csv
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

import cv2
import numpy as np

LEAST = 150  # pixels of a thing: what pcl_sq_scene leaves out by default
OWN = 0.75


def lzf(data, size):
    """Decompresses what LibLZF made, as PCL's binary_compressed files hold it."""
    out = bytearray()
    i = 0
    while i < len(data):
        control = data[i]
        i += 1
        if control < 32:
            out += data[i:i + control + 1]
            i += control + 1
            continue
        length = control >> 5
        if length == 7:
            length += data[i]
            i += 1
        start = len(out) - ((control & 31) << 8) - data[i] - 1
        i += 1
        for k in range(length + 2):
            out.append(out[start + k])
    if len(out) != size:
        raise ValueError("damaged PCD file")
    return bytes(out)


def pcd_labels(path):
    """Things of an organized, compressed PCD file with a field "label" in front."""
    data = path.read_bytes()
    begin = data.index(b"DATA binary_compressed\n") + len(b"DATA binary_compressed\n")
    head = dict(line.split(" ", 1) for line in data[:begin].decode().splitlines()
                if " " in line and not line.startswith("#"))
    if head["FIELDS"].split()[0] != "label":
        raise ValueError(f"{path}: no labels")
    packed, size = struct.unpack("<II", data[begin:begin + 8])
    count = int(head["POINTS"])
    values = np.frombuffer(lzf(data[begin + 8:begin + 8 + packed], size)[:4 * count], "<u4")
    things = np.where(values >= 20, values // 10 - 1, 0)
    return things.reshape(int(head["HEIGHT"]), int(head["WIDTH"]))


def read_case(path):
    """Arguments of the program, labels, and height of each label where it is known [mm]."""
    if path.is_file():
        return [str(path)], pcd_labels(path), {}
    with open(path / "camera_and_roi.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    heights = {int(r["label"]): float(r["top_above_table_mm"]) for r in rows}
    depth = next(path.glob("depth_*mm.png"))
    unit = depth.stem.split("_")[1].removesuffix("mm")
    intrinsics = ",".join(rows[0][k] for k in ("fx", "fy", "cx", "cy"))
    arguments = [str(path / "color.png"), "--depth", str(depth), "--depth-scale",
                 str(float(unit) / 1000.0), "--intrinsics", intrinsics]
    labels = cv2.imread(str(path / "labels.png"), cv2.IMREAD_UNCHANGED)
    return arguments, np.where(np.isin(labels, list(heights)), labels, 0), heights


def score(truth, found, scene, heights):
    things = [k for k in np.unique(truth) if k and (truth == k).sum() >= LEAST]
    pieces = [k for k in np.unique(found) if k]
    both = np.array([[np.sum((truth == t) & (found == p)) for p in pieces] for t in things])
    both = both.reshape(len(things), len(pieces))
    of_thing = np.array([(truth == t).sum() for t in things])
    of_piece = np.array([(found == p).sum() for p in pieces])
    iou = both / np.maximum(of_thing[:, None] + of_piece[None, :] - both, 1)
    best = iou.max(1) if pieces else np.zeros(len(things))
    errors = []
    by_label = dict(enumerate(scene["objects"], 1))
    for i, thing in enumerate(things):
        piece = pieces[int(iou[i].argmax())] if pieces else None
        if best[i] >= OWN and thing in heights and piece in by_label:
            errors.append((by_label[piece]["size"][2] * 1e3 - heights[thing], heights[thing]))
    share = both / np.maximum(of_thing[:, None], 1)
    inside = both / np.maximum(of_piece[None, :], 1)
    return {"things": len(things), "own": int((best >= OWN).sum()), "iou": best.tolist(),
            "merged": int(((share > 0.5).sum(0) > 1).sum()),
            "extra": int(((share < 0.5) & (inside < 0.5)).all(0).sum()
                         + ((share < 0.5) & (inside >= 0.5)).any(0).sum()),
            "heights": errors}


def line(name, s):
    worst = max(s["heights"], key=lambda e: abs(e[0]), default=None)
    height = f"{worst[0]:+.0f} mm {100 * worst[0] / worst[1]:+.0f} %" if worst else "-"
    print(f"{name:22s} things {s['things']:3d} own {100 * s['own'] / max(1, s['things']):5.1f} %"
          f" mean {np.mean(s['iou'] or [0]):.3f} merged {s['merged']} extra {s['extra']}"
          f" height {height} ms {s['ms']:.0f}", flush=True)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("cases", nargs="+", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path)
    own = sys.argv[1:]
    options = own[own.index("--") + 1:] if "--" in own else []
    arguments = parser.parse_args(own[:own.index("--")] if "--" in own else own)
    results, failed = {}, False
    with tempfile.TemporaryDirectory() as scratch:
        out = arguments.out or pathlib.Path(scratch)
        out.mkdir(parents=True, exist_ok=True)
        for case in arguments.cases:
            command, truth, heights = read_case(case)
            base = out / case.stem
            run = subprocess.run(
                [arguments.bin / "pcl_sq_scene", *command, "-q", "-o", f"{base}.json",
                 "--write-labels", f"{base}_labels.png", "--panel", f"{base}.png", *options],
                check=False, capture_output=True, text=True)
            if run.returncode:
                print(f"{case.name}: {run.stderr.strip().splitlines()[-1:]}", flush=True)
                failed = True
                continue
            with open(f"{base}.json", encoding="utf-8") as file:
                scene = json.load(file)
            found = cv2.imread(f"{base}_labels.png", cv2.IMREAD_UNCHANGED)
            results[case.stem] = score(truth, found, scene, heights)
            timings = scene["timings_ms"]
            results[case.stem]["ms"] = timings["total"] - timings["load"]
            line(case.stem, results[case.stem])
    if results:
        everything = {k: sum((r[k] for r in results.values()), type(r0)())
                      for k, r0 in next(iter(results.values())).items()
                      if not isinstance(r0, float)}
        everything["ms"] = float(np.mean([r["ms"] for r in results.values()]))
        line("all", everything)
    if arguments.json:
        arguments.json.write_text(json.dumps(results, indent=1), encoding="utf-8")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
