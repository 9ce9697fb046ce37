#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Raw stereo pairs of real meshes through the whole chain: images to model to overlap.

usage: mesh_pairs.py SYNTHETIC_STEREO BIN [--matchers bm sgbm] [--keep DIR] [OPTION...]

SYNTHETIC_STEREO holds one folder per object with raw_left.png, raw_right.png,
calib_raw.yml and gt.yml (mesh, T_mesh_to_rawleft, roi_rect_xywh); BIN the programs. Each
pair goes through pcl_sq_stereo, in the default mode plus the given OPTIONs, with the
object's box drawn 8 px too large, and pcl_sq_evaluate compares the model with the mesh
where it truly is. A hollow mug cannot be a union of superquadrics: its body is closed
(the convex hull of everything but the handle is filled).
"""
import argparse
import json
import pathlib
import re
import struct
import subprocess
import tempfile

import numpy as np
from scipy.spatial import ConvexHull


def matrix(text, name):
    block = re.search(name + r":.*?data: \[(.*?)\]", text, re.S).group(1)
    return np.array([float(x) for x in block.split(",")])


def read_mesh(path):
    if path.suffix == ".stl":
        data = path.read_bytes()
        count = struct.unpack("<I", data[80:84])[0]
        record = np.frombuffer(data[84:84 + 50 * count],
                               np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]))
        return record["v"].reshape(-1, 3).astype(float), np.arange(3 * count).reshape(-1, 3)
    vertices, faces = [], []
    for line in path.read_text().splitlines():
        word = line.split()
        if word and word[0] == "v":
            vertices.append([float(x) for x in word[1:4]])
        elif word and word[0] == "f":
            index = [int(w.split("/")[0]) - 1 for w in word[1:]]
            faces += [[index[0], index[i], index[i + 1]] for i in range(1, len(index) - 1)]
    return np.array(vertices), np.array(faces)


def rotation(vector):
    """Rodrigues' formula."""
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def rotation_vector(r):
    axis = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / 2
    sine = np.linalg.norm(axis)
    return axis / max(sine, 1e-300) * np.arctan2(sine, (np.trace(r) - 1) / 2)


def rectification(r, t):
    """How rectification turns the left camera (Bouguet): both cameras by half of their
    rotation, then the baseline onto the image rows."""
    half = rotation(-0.5 * rotation_vector(r))
    line = half @ t
    towards = np.array([np.sign(line[0]), 0.0, 0.0])
    axis = np.cross(line, towards)
    if np.linalg.norm(axis) > 0.0:
        axis *= np.arccos(abs(line[0]) / np.linalg.norm(line)) / np.linalg.norm(axis)
    return rotation(axis) @ half.T


def close_mug(vertices, triangles):
    """The mesh with the inside of its body filled; its axis is z."""
    rim = vertices[vertices[:, 2] > vertices[:, 2].max() - 0.003, :2]
    low, high = rim.min(0), rim.max(0)
    centre, radius = (low + high) / 2, (high - low).min() / 2
    body = vertices[np.linalg.norm(vertices[:, :2] - centre, axis=1) < 1.02 * radius]
    hull = ConvexHull(body)
    outwards = hull.simplices.copy()
    middle = body.mean(0)
    for i, (a, b, c) in enumerate(outwards):
        if np.dot(np.cross(body[b] - body[a], body[c] - body[a]), body[a] - middle) < 0:
            outwards[i] = a, c, b
    return (np.vstack([vertices, body]),
            np.vstack([triangles, outwards + len(vertices)]))


def write_obj(path, vertices, triangles):
    with open(path, "w") as f:
        f.writelines("v %.9g %.9g %.9g\n" % tuple(v) for v in vertices)
        f.writelines("f %d %d %d\n" % tuple(t + 1) for t in triangles)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("pairs", type=pathlib.Path)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--matchers", nargs="+", default=["bm", "sgbm"])
    parser.add_argument("--keep", type=pathlib.Path, help="folder for models and panels")
    args, options = parser.parse_known_args()
    out = args.keep or pathlib.Path(tempfile.mkdtemp())
    out.mkdir(parents=True, exist_ok=True)
    print("object matcher: superquadrics, IoU, errors of width, height, thickness, "
          "centre [mm]; time of observe + fit [ms]")
    for folder in sorted(p for p in args.pairs.iterdir() if (p / "gt.yml").exists()):
        truth = (folder / "gt.yml").read_text()
        calibration = (folder / "calib_raw.yml").read_text()
        turn = np.eye(4)
        turn[:3, :3] = rectification(matrix(calibration, r"\nR").reshape(3, 3),
                                     matrix(calibration, r"\nT"))
        pose = turn @ matrix(truth, "T_mesh_to_rawleft").reshape(4, 4)
        x, y, w, h = matrix(truth, "roi_rect_xywh")
        mesh = (folder / re.search(r'mesh: "(.*?)"', truth).group(1)).resolve()
        if folder.name == "mug":
            closed = out / "mug_closed.obj"
            write_obj(closed, *close_mug(*read_mesh(mesh)))
            mesh = closed
        # the box is that of the ideal pair; in the raw one it lies a few pixels away
        roi = "%d,%d,%d,%d" % (x - 8, y - 8, w + 16, h + 16)
        for matcher in args.matchers:
            name = out / f"{folder.name}_{matcher}"
            run = subprocess.run(
                [args.bin / "pcl_sq_stereo", folder / "raw_left.png",
                 folder / "raw_right.png", "--calib", folder / "calib_raw.yml",
                 "--matcher", matcher, "--roi", roi, "--quiet", "--output",
                 f"{name}.json", *options], capture_output=True, text=True)
            if run.returncode:
                print(folder.name, matcher, "failed:", run.stderr.strip())
                continue
            scores = json.loads(subprocess.run(
                [args.bin / "pcl_sq_evaluate", f"{name}.json", "--mesh", mesh, "--pose",
                 ",".join("%.17g" % v for v in pose.ravel())],
                capture_output=True, text=True, check=True).stdout)
            size = scores["shape"]["size_error"]
            timings = json.loads(pathlib.Path(f"{name}.json").read_text())["timings_ms"]
            print("%-15s %-5s %d  %.3f   %s  %.1f   %.0f" % (
                folder.name, matcher, scores["superquadrics"], scores["shape"]["iou"],
                " ".join("%+5.1f" % (1e3 * size[k])
                         for k in ("width", "height", "thickness")),
                1e3 * scores["shape"]["center_distance"],
                timings["observe"] + timings["fit"]), flush=True)


if __name__ == "__main__":
    main()
