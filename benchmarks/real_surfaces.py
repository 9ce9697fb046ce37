#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How far the true surface of real things lies off their models.

usage: real_surfaces.py DATA RESULTS [OTHER_RESULTS...]

DATA is that of real_pairs.py, with disp0.pfm in the folders whose disparity is known;
RESULTS the folders that real_pairs.py --out left. Of each thing that has a model in all of
them, true points under its mask, three pixels off its rim, are looked at: their mean
distance to the model [mm], at most 50 each. Sizes of a few things, right or wrong by a
tolerance, change by chance as much as by what is changed; distances do so less.
"""
import json
import pathlib
import sys

import numpy as np
from PIL import Image
from scipy import ndimage
from scipy.spatial import cKDTree

from real_pairs import surface
from real_tables import true_cloud

RIM = 3           # [px] where the outline may be another's
FARTHEST = 0.05   # [m] that a point counts: beyond, it is not the thing's
BEHIND = 0.15     # of the depth: what shows through gaps is not the thing's


def distances(cloud, stem):
    """Of the true points to the model, or None without a model."""
    model = pathlib.Path(f"{stem}.json")
    mask = pathlib.Path(f"{stem}_mask.png")
    if not model.exists() or not mask.exists():
        return None
    own = ndimage.binary_erosion(np.array(Image.open(mask).convert("L")) > 127,
                                 iterations=RIM)
    points = cloud[own]
    points = points[np.isfinite(points).all(1)]
    if len(points) < 50:
        return None
    depth = np.median(points[:, 2])
    points = points[np.abs(points[:, 2] - depth) < BEHIND * depth]
    points = points[::max(1, len(points) // 600)]
    bodies = [surface(part, 160) for part in json.loads(model.read_text())["superquadrics"]]
    return np.minimum(cKDTree(np.concatenate(bodies)).query(points)[0], FARTHEST)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    data, *results = map(pathlib.Path, sys.argv[1:])
    means = []
    for folder in sorted(f for f in data.iterdir() if (f / "disp0.pfm").exists() and
                         (f / "calib.txt").exists()):
        cloud = true_cloud(folder)
        for model in sorted(results[0].glob(f"{folder.name}_*.json")):
            off = [distances(cloud, r / model.stem) for r in results]
            if any(o is None for o in off):
                continue
            means.append([(1e3 * o.mean(), 100 * (o > 0.01).mean()) for o in off])
            print("%-36s" % model.stem, *("%5.1f mm" % m[0] for m in means[-1]))
    for r, of_folder in zip(results, np.swapaxes(np.array(means), 0, 1)):
        print("%s: %d things, mean %.2f mm, median %.2f mm, %.0f %% of the points 1 cm off" %
              (r, len(of_folder), of_folder[:, 0].mean(), np.median(of_folder[:, 0]),
               of_folder[:, 1].mean()))


if __name__ == "__main__":
    main()
