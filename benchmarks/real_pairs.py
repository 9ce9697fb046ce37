#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Real stereo pairs through the whole chain: every pair, every box, judged and shown.

usage: real_pairs.py DATA BIN [--out DIR] [--random N | --moved N] [--seed S] [--only SET]
                     [OPTION...]

DATA holds a folder per pair with im0.png, im1.png, calib.txt (Middlebury's format) and
rois.csv (object,x,y,w,h), and a truth.csv: set,object,kind,a,b,tolerance, extents of the
object along the left camera's x and y axes [m]. BIN is the folder of the programs; OPTIONs
go to pcl_sq_stereo. Each box goes through pcl_sq_stereo; --random N takes N random boxes
instead, half of them anywhere, half of them around an object. --moved N takes each box of a
known size N times, each of its sides moved by -2 to 5 pixels outwards, as other hands draw it.

A model is nonsense where its points lie more than 3 cm off, or a part is thinner than 1 mm
or longer than 1.5 m. "seen" is the share of the object's pixels that the model covers.
--out keeps models and panels, and one sheet.png of all panels.
"""
import argparse
import collections
import csv
import json
import pathlib
import random
import subprocess
import tempfile

import numpy as np
from PIL import Image, ImageDraw
from scipy.spatial import ConvexHull

Truth = collections.namedtuple("Truth", "width height tolerance")


def read_csv(path):
    with open(path) as f:
        return [row for row in csv.reader(f) if row and not row[0].startswith("#")]


def surface(part, steps=120):
    """Points of a superquadric's surface up to its rim, in the camera's frame."""
    heights = np.concatenate([np.linspace(-1, part.get("rim", 1), steps), [-0.9999]])
    z, omega = np.meshgrid(heights, np.linspace(-np.pi, np.pi, steps))

    def power(x, e):
        return np.sign(x) * np.abs(x) ** e
    e1, e2 = part["epsilon"]
    a = part["semi_axes"]
    c = np.maximum(1 - np.abs(z) ** (2 / e1), 0) ** (e1 / 2)
    p = np.stack([a[0] * c * power(np.cos(omega), e2), a[1] * c * power(np.sin(omega), e2),
                  a[2] * z], -1).reshape(-1, 3)
    kx, ky = part.get("taper", (0, 0))
    p[:, 0] *= kx * p[:, 2] / a[2] + 1
    p[:, 1] *= ky * p[:, 2] / a[2] + 1
    if "bend" in part:  # z on a circle of this curvature, towards x turned by this angle
        curvature, angle = part["bend"]
        c, s = np.cos(angle), np.sin(angle)
        along, across = p[:, 0] * c + p[:, 1] * s, p[:, 1] * c - p[:, 0] * s
        rest = 1 / curvature - along
        turn = p[:, 2] * curvature
        along = 1 / curvature - rest * np.cos(turn)
        p = np.stack([along * c - across * s, along * s + across * c,
                      rest * np.sin(turn)], -1)
    return p @ np.array(part["rotation"]).T + np.array(part["translation"])


def silhouette(bodies, camera, size):
    """Pixels that the parts cover."""
    image = Image.new("1", size)
    draw = ImageDraw.Draw(image)
    for p in bodies:
        p = p[p[:, 2] > 1e-6]
        uv = np.stack([camera["fx"] * p[:, 0] / p[:, 2] + camera["cx"],
                       camera["fy"] * p[:, 1] / p[:, 2] + camera["cy"]], -1)
        uv = np.clip(uv, -1e5, 1e5)
        if len(uv) > 3 and (np.ptp(uv, 0) > 1e-3).all():
            draw.polygon([tuple(x) for x in uv[ConvexHull(uv).vertices]], fill=1)
    return np.array(image)


def judge(model, mask, box, truth):
    bodies = [surface(part) for part in model["superquadrics"]]
    everything = np.concatenate(bodies)
    width, height = np.ptp(everything, 0)[:2]
    # of a cut body what is there, up to its rim
    sides = [np.array(part["semi_axes"]) * (2, 2, 1 + part.get("rim", 1))
             for part in model["superquadrics"]]
    nonsense = (model["rms_distance"] > 0.03 or min(s.min() for s in sides) < 1e-3 or
                max(s.max() for s in sides) > 1.5)
    covered = silhouette(bodies, model["stereo"]["camera"], mask.size)
    own = np.array(mask) > 127
    if not own.any():
        x, y, w, h = box
        own[max(y, 0):y + h, max(x, 0):x + w] = True
    right = None
    if truth:
        right = bool(abs(width / truth.width - 1) <= truth.tolerance and
                     abs(height / truth.height - 1) <= truth.tolerance)
    return {"width": width, "height": height, "nonsense": nonsense, "right": right,
            "seen": (own & covered).sum() / own.sum(),
            "overlap": (own & covered).sum() / (own | covered).sum(),
            "rms": model["rms_distance"], "parts": len(bodies),
            "confidence": model.get("confidence"), "table": "table" in model}


def run(folder, box, name, args, options):
    """One box through the program: what is to be said of it, and the panel."""
    command = [args.bin / "pcl_sq_stereo", folder / "im0.png", folder / "im1.png", "--calib",
               folder / "calib.txt", "--roi", ",".join(map(str, box)), "--output",
               f"{name}.json", "--panel", f"{name}.png", "--write-mask", f"{name}_mask.png",
               *options]
    for old in (f"{name}.json", f"{name}.png", f"{name}_mask.png"):
        pathlib.Path(old).unlink(missing_ok=True)
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    said = [line.split(": ", 1)[-1] for line in done.stderr.strip().splitlines()
            if "pcl_sq_stereo:" in line]
    return done.returncode, said


def tile(path, text, bad, width=1000):
    shown = Image.open(path).convert("RGB") if path.exists() else Image.new("RGB", (1472, 200))
    shown = shown.resize((width, shown.height * width // shown.width))
    result = Image.new("RGB", (width, shown.height + 22), (255, 200, 200) if bad else "white")
    ImageDraw.Draw(result).text((6, 5), text[:160], fill="black")
    result.paste(shown, (0, 22))
    return result


def write_sheet(path, tiles, columns=3):
    rows = [tiles[i:i + columns] for i in range(0, len(tiles), columns)]
    width = max(t.width for t in tiles)
    sheet = Image.new("RGB", (columns * width, sum(max(t.height for t in r) for r in rows)))
    y = 0
    for row in rows:
        for i, t in enumerate(row):
            sheet.paste(t, (i * width, y))
        y += max(t.height for t in row)
    sheet.save(path)


def random_box(dice, size, boxes):
    """Anywhere, or moved and stretched by up to half from an object's."""
    if dice.random() < 0.5:
        w, h = (int(s * dice.uniform(0.05, 0.5)) for s in size)
        return dice.randrange(size[0] - w), dice.randrange(size[1] - h), w, h
    x, y, w, h = dice.choice(boxes)
    return (max(0, x + int(w * dice.uniform(-.5, .5))), max(0, y + int(h * dice.uniform(-.5, .5))),
            int(w * dice.uniform(.6, 1.5)), int(h * dice.uniform(.6, 1.5)))


def moved_box(dice, size, box):
    """Each side moved by -2 to 5 pixels outwards, as far as the image goes."""
    x, y, w, h = box
    left, top, right, bottom = (dice.randint(-2, 5) for _ in range(4))
    x1, y1 = max(0, x - left), max(0, y - top)
    return (x1, y1, min(size[0], x + w + right) - x1, min(size[1], y + h + bottom) - y1)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, help="folder for models and panels")
    parser.add_argument("--random", type=int, default=0, help="number of random boxes")
    parser.add_argument("--moved", type=int, default=0, help="draws of each box")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", help="one pair")
    args, options = parser.parse_known_args()
    out = args.out or pathlib.Path(tempfile.mkdtemp())
    out.mkdir(parents=True, exist_ok=True)
    truths = {(r[0], r[1]): Truth(*map(float, r[3:6]))
              for r in read_csv(args.data / "truth.csv") if r[2] == "all"}
    folders = [f for f in sorted(args.data.iterdir())
               if (f / "rois.csv").exists() and (f / "calib.txt").exists() and
               args.only in (None, f.name)]
    jobs = []
    for folder in folders:
        rows = [(r[0], tuple(map(int, r[1:5]))) for r in read_csv(folder / "rois.csv")[1:]]
        size = Image.open(folder / "im0.png").size
        dice = random.Random(f"{args.seed} {folder.name}")
        if args.moved:
            jobs += [(folder, name, f"{name}_moved{i}", moved_box(dice, size, box))
                     for i in range(args.moved) for name, box in rows
                     if (folder.name, name) in truths]
        elif not args.random:
            jobs += [(folder, name, name, box) for name, box in rows]
        else:
            boxes = [box for _, box in rows]
            count = -(-args.random // len(folders))
            jobs += [(folder, "random", f"random{i}", random_box(dice, size, boxes))
                     for i in range(count)]
    right = asked = nonsense = models = unexplained = 0
    tiles = []
    for folder, name, shown, box in jobs:
        stem = out / f"{folder.name}_{shown}"
        code, said = run(folder, box, stem, args, options)
        truth = truths.get((folder.name, name))
        asked += truth is not None
        title = f"{folder.name} {shown}"
        if code == 0:
            model = json.loads(pathlib.Path(f"{stem}.json").read_text())
            mask = pathlib.Path(f"{stem}_mask.png")
            mask = (Image.open(mask).convert("L") if mask.exists() else
                    Image.new("L", Image.open(folder / "im0.png").size))
            j = judge(model, mask, box, truth)
            models += 1
            right += j["right"] is True
            nonsense += j["nonsense"]
            unexplained += j["seen"] < 0.8
            text = "%-28s %s %4.0f x %4.0f%s mm  seen %3.0f %%  overlap %.2f  rms %5.1f mm  " \
                "%d parts%s%s%s" % (
                    title, {True: "right", False: "WRONG", None: "     "}[j["right"]],
                    1e3 * j["width"], 1e3 * j["height"],
                    " of %4.0f x %4.0f" % (1e3 * truth.width, 1e3 * truth.height)
                    if truth else 15 * " ", 100 * j["seen"], j["overlap"], 1e3 * j["rms"],
                    j["parts"], "" if j["table"] else "  no table",
                    "" if j["confidence"] is None else "  confidence %.2f" % j["confidence"],
                    "  NONSENSE" if j["nonsense"] else "")
            tiles.append(tile(pathlib.Path(f"{stem}.png"), text,
                              j["right"] is False or j["nonsense"]))
        else:
            text = "%-28s exit %d: %s" % (title, code, said[-1] if said else "")
            tiles.append(tile(pathlib.Path(f"{stem}.png"), text, True))
        print(text, flush=True)
    print(f"{len(jobs)} boxes, {models} models, {nonsense} of them nonsense, {unexplained} "
          f"cover less than 80 % of their object; sizes right {right} of {asked}")
    if args.out:
        write_sheet(out / "sheet.png", tiles)


if __name__ == "__main__":
    main()
