#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Epsilon of planned grasps once more, by other means: scipy's hull of densely cut cones.

usage: grasp_epsilon.py GRASPS.json... [--edges 12 16 20] [--count 3]

Each GRASPS.json is what pcl_sq_grasp -o wrote. A hull of cut cones lies inside of the true
one; its error falls with the square of the number of edges, so that the values of several
numbers are extrapolated to infinitely many (Richardson). Needs numpy and scipy.
"""
import argparse
import json
import sys

import numpy as np
from scipy.spatial import ConvexHull


def wrenches(grasp, file, edges):
    origin = np.array(file["wrench"]["origin"])
    length, torsion = file["wrench"]["torque_length"], file["wrench"]["torsional_friction"]
    points = []
    for contact in grasp["contacts"]:
        n = -np.array(contact["normal"])
        lever = (np.array(contact["position"]) - origin) / length
        u = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
        u /= np.linalg.norm(u)
        v = np.cross(n, u)
        # an ellipsoid of tangential force and torque: circles of latitude
        for i in range(edges // 2 + 1):
            latitude = np.pi * (i / (edges // 2) - .5)
            for k in range(edges if 0 < i < edges // 2 else 1):
                angle = 2 * np.pi * k / edges
                force = n + file["friction"] * np.cos(latitude) * (
                    np.cos(angle) * u + np.sin(angle) * v)
                torque = np.cross(lever, force) + torsion / length * np.sin(latitude) * n
                points.append(np.r_[force, torque])
    return np.array(points)


def epsilon(grasp, file, edges):
    # joggled: many wrenches share a facet of a pinch
    return -ConvexHull(wrenches(grasp, file, edges), qhull_options="QJ").equations[:, -1].max()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grasps", nargs="+")
    parser.add_argument("--edges", type=int, nargs="*", default=[12, 16, 20])
    parser.add_argument("--count", type=int, default=3, help="best grasps of each file")
    args = parser.parse_args()
    worst = 0.0
    for path in args.grasps:
        with open(path) as stream:
            file = json.load(stream)
        for grasp in file["grasps"][:args.count]:
            values = [epsilon(grasp, file, m) for m in args.edges]
            design = np.c_[np.ones(len(values)), 1.0 / np.square(args.edges)]
            limit = np.linalg.lstsq(design, np.array(values), rcond=None)[0][0]
            error = grasp["epsilon"] / limit - 1
            worst = max(worst, abs(error))
            cut = " ".join(f"{v:.5f}" for v in values)
            print(f"{path}: ours {grasp['epsilon']:.5f}, cut {cut} -> {limit:.5f}"
                  f" ({100 * error:+.2f} %)", flush=True)
    print(f"largest difference {100 * worst:.2f} %")
    sys.exit(int(worst > 0.02))


if __name__ == "__main__":
    main()
