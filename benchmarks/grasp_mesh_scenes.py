#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns rendered pairs with a known mesh into scenes for grasp_evaluation.py.

usage: grasp_mesh_scenes.py SYNTHETIC_STEREO OUT [--noises N]

SYNTHETIC_STEREO holds one folder per object with calib_rect.yml, gt.yml, rect_disp0.pfm
and rect_mask.png. Each OUT/<name>_<k>/ gets cloud.pcd (organized; the exact disparity with
noise of 0.25 px, rounded to 1/16 px, 2 % outliers, 3 % missing), mask.png, object.xyz,
truth.off (the mesh in the camera's frame [m]) and truth.json (the table).
"""
import argparse
import json
import pathlib
import re
import shutil
import struct

import numpy as np


def matrix(text, name):
    block = re.search(name + r":.*?data: \[(.*?)\]", text, re.S).group(1)
    return np.array([float(x) for x in block.split(",")])


def number(text, name):
    return float(re.search(name + r": *([-+0-9.eE]+)", text).group(1))


def read_pfm(path):
    with open(path, "rb") as f:
        f.readline()
        width, height = map(int, f.readline().split())
        f.readline()
        return np.frombuffer(f.read(), "<f4").reshape(height, width)[::-1].astype(float)


def read_png_gray(path):
    import zlib
    data = path.read_bytes()
    at, chunks = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", data[at + 8:at + 18])
            assert depth == 8 and color == 0, "the mask is not 8-bit grey"
        if kind == b"IDAT":
            chunks += data[at + 8:at + 8 + size]
        at += 12 + size
    rows = np.frombuffer(zlib.decompress(chunks), np.uint8).reshape(height, width + 1)
    out = np.zeros((height, width), np.uint8)
    for y in range(height):
        line, before = rows[y, 1:].astype(int), out[y - 1].astype(int) if y else np.zeros(width, int)
        kind = rows[y, 0]
        if kind == 0:
            out[y] = line
        elif kind == 2:
            out[y] = (line + before) % 256
        else:  # left, average, Paeth: one pixel after the other
            for x in range(width):
                a = int(out[y, x - 1]) if x else 0
                b, c = int(before[x]), int(before[x - 1]) if x else 0
                p = a + b - c
                paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
                out[y, x] = (line[x] + {1: a, 3: (a + b) // 2, 4: paeth}[kind]) % 256
    return out


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


def write_pcd(path, xyz):
    height, width = xyz.shape[:2]
    head = (f"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
            f"WIDTH {width}\nHEIGHT {height}\nVIEWPOINT 0 0 0 1 0 0 0\n"
            f"POINTS {width * height}\nDATA binary\n")
    path.write_bytes(head.encode() + xyz.astype("<f4").tobytes())


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--noises", type=int, default=3, help="scenes per pair")
    args = parser.parse_args()
    for folder in sorted(p.parent for p in args.data.glob("*/gt.yml")):
        truth, calib = (folder / "gt.yml").read_text(), (folder / "calib_rect.yml").read_text()
        f, cx, cy = (number(calib, n) for n in ("f", "cx", "cy"))
        baseline = number(calib, "baseline_m")
        pose = matrix(truth, "T_mesh_to_rectleft").reshape(4, 4)
        mesh_name = re.search(r'mesh: "(.*?)"', truth).group(1)
        vertices, faces = read_mesh((folder / mesh_name).resolve())
        vertices = vertices @ pose[:3, :3].T + pose[:3, 3]
        exact = read_pfm(folder / "rect_disp0.pfm")
        mask = read_png_gray(folder / "rect_mask.png") > 127
        y, x = np.mgrid[:exact.shape[0], :exact.shape[1]]
        for k in range(args.noises):
            rng = np.random.default_rng([k, len(folder.name)])
            disparity = np.round((exact + rng.normal(0, .25, exact.shape)) * 16) / 16
            outlier = rng.random(exact.shape) < .02
            disparity = np.where(outlier, rng.uniform(30, 140, exact.shape), disparity)
            bad = (rng.random(exact.shape) < .03) | ~np.isfinite(disparity) | (disparity < 10)
            z = np.where(bad, np.nan, f * baseline / np.where(bad, 1, disparity))
            xyz = np.stack([(x - cx) / f * z, (y - cy) / f * z, z], -1)
            out = args.out / f"{folder.name}_{k}"
            out.mkdir(parents=True, exist_ok=True)
            write_pcd(out / "cloud.pcd", xyz)
            shutil.copy(folder / "rect_mask.png", out / "mask.png")
            points = xyz[mask]
            np.savetxt(out / "object.xyz", points[np.isfinite(points).all(1)], fmt="%.6f")
            with open(out / "truth.off", "w") as off:
                off.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
                np.savetxt(off, vertices, fmt="%.7f")
                np.savetxt(off, np.c_[np.full(len(faces), 3), faces], fmt="%d")
            table = matrix(truth, "table_plane_rectleft")
            (out / "truth.json").write_text(json.dumps(
                {"name": folder.name, "table": list(table),
                 "camera": {"f": f, "cx": cx, "cy": cy}}))
            print(out, int(mask.sum()), "pixels")


if __name__ == "__main__":
    main()
