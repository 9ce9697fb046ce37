#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tables that were found under things of real stereo pairs, against the true disparity.

usage: real_tables.py DATA RESULTS

DATA is that of real_pairs.py, with disp0.pfm in the folders whose disparity is known;
RESULTS the folder that real_pairs.py --out left. Planes of the true cloud around each
thing are found by RANSAC (tolerance 0.6 % of the depth); those that may be its table face
up, hold one in thirty of the points there, and the thing stands on them or up to a quarter
of its size above. Printed is the one nearest to the table that was found: the angle between
the two [deg], and their distance below the thing [mm]. Where no such plane is near, a
table is printed as "no such plane"; a plane without a table as "not found".
"""
import csv
import json
import pathlib
import sys

import numpy as np
from PIL import Image
from scipy import ndimage

TOLERANCE = 0.006  # of the depth
UPRIGHT = 0.25     # of a table's normal in the image


def read_pfm(path):
    with open(path, "rb") as f:
        f.readline()
        width, height = map(int, f.readline().split())
        kind = "<f4" if float(f.readline()) < 0 else ">f4"
        return np.frombuffer(f.read(), kind).reshape(height, width)[::-1].copy()


def true_cloud(folder):
    """H x W x 3, NaN where nothing is known."""
    lines = (folder / "calib.txt").read_text().splitlines()
    calib = dict(line.strip().split("=", 1) for line in lines if "=" in line)
    k = list(map(float, calib["cam0"].strip("[]").replace(";", " ").split()))
    d = read_pfm(folder / "disp0.pfm")
    d[~np.isfinite(d) | (d == 0)] = np.nan
    z = k[0] * float(calib["baseline"]) / 1000 / (d + float(calib["doffs"]))
    v, u = np.mgrid[:d.shape[0], :d.shape[1]]
    return np.stack([(u - k[2]) * z / k[0], (v - k[5]) * z / k[4], z], -1)


def plane_through(points):
    middle = points.mean(0)
    normal = np.linalg.svd(points - middle, full_matrices=False)[2][2]
    offset = -normal @ middle
    return (normal, offset) if offset > 0 else (-normal, -offset)


def planes(points, tolerance, dice):
    """Normal, offset and share of the points of the largest planes, one after the other."""
    rest = points
    for _ in range(8):
        if len(rest) < max(200, 0.03 * len(points)):
            return
        sample = rest[dice.integers(0, len(rest), 1500)]
        best, most = None, 0
        for _ in range(3000):
            a, b, c = rest[dice.integers(0, len(rest), 3)]
            normal = np.cross(b - a, c - a)
            length = np.linalg.norm(normal)
            if length > 1e-9:
                normal /= length
                votes = (abs((sample - a) @ normal) < tolerance).sum()
                if votes > most:
                    best, most = (normal, -normal @ a), votes
        for _ in range(5):
            best = plane_through(rest[abs(rest @ best[0] + best[1]) < tolerance])
        off = abs(rest @ best[0] + best[1])
        yield *best, (off < tolerance).sum() / len(points)
        rest = rest[off > 2 * tolerance]


def around(mask, box):
    """Pixels beside a thing, of which most lie below and beside it."""
    x, y, w, h = box
    margin = max(20, (w + h) // 3)
    ring = np.zeros_like(mask)
    ring[max(0, y - margin // 3):y + h + margin, max(0, x - margin):x + w + margin] = True
    return ring & ~ndimage.binary_dilation(mask, iterations=4)


def compare(cloud, mask, box, table, dice):
    known = np.isfinite(cloud[..., 2])
    thing = cloud[mask & known]
    depth = np.median(thing[:, 2])
    thing = thing[abs(thing[:, 2] - depth) < 0.2 * depth]
    size = np.ptp(thing, 0).max()
    best = None
    for normal, offset, share in planes(cloud[around(mask, box) & known],
                                        TOLERANCE * depth, dice):
        low = np.percentile(thing @ normal + offset, 2)
        if share < 0.03 or -normal[1] < UPRIGHT or not -0.03 < low < 0.25 * size:
            continue
        if table is None:
            return "not found: a plane with %.0f %% of what is around" % (100 * share)
        angle = np.degrees(np.arccos(min(1, abs(normal @ table[:3]))))
        middle = thing.mean(0)
        foot = middle - (middle @ normal + offset) * normal
        this = (angle, 1e3 * (foot @ table[:3] + table[3]))
        best = min(best or this, this)
    if table is None:
        return None
    return "%4.1f deg %6.1f mm" % best if best else "no such plane"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    data, results = map(pathlib.Path, sys.argv[1:])
    for folder in sorted(f for f in data.iterdir() if (f / "disp0.pfm").exists() and
                         (f / "rois.csv").exists()):
        cloud = true_cloud(folder)
        with open(folder / "rois.csv") as f:
            rows = list(csv.reader(f))[1:]
        for name, *box in (row[:5] for row in rows):
            stem = results / f"{folder.name}_{name}"
            if not stem.with_suffix(".json").exists() or \
                    not pathlib.Path(f"{stem}_mask.png").exists():
                continue
            table = json.loads(stem.with_suffix(".json").read_text()).get("table")
            mask = np.array(Image.open(f"{stem}_mask.png").convert("L")) > 127
            said = compare(cloud, mask, tuple(map(int, box)),
                           None if table is None else np.array(table),
                           np.random.default_rng(0))
            if said:
                print("%-28s %s" % (f"{folder.name} {name}", said), flush=True)


if __name__ == "__main__":
    main()
