#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whole objects without a camera: clouds of meshes, of files, of chairs and tables.

usage: whole_objects.py BIN [FILE...] [--furniture N] [--seeds 0 1 2] [--points 5000]
                        [--up z] [--json OUT] [-- OPTION...]

BIN holds pcl_sq_fit, which gets the given OPTIONs and one thread. Each mesh (OBJ, STL) is
sampled evenly over its area once a seed; a cloud (PLY, ASCII) is thinned to nine tenths.
--furniture adds N chairs and tables of boxes and rods.

One line an object, means over the seeds:
  CD      Chamfer distance, mean of both ways, % of the box's diagonal, outer surfaces: what
          a hollow thing holds and walls towards it do not count
  IoU     of the solids, filled up to the rim (what is enclosed in its horizontal section)
  IoUm    of the material
  parts   one number a seed
  CPU     [s] of the program, reading the file included
  out     how far the model leaves the box of the points, % of the box's longest side
  legs    share of the furniture's legs of which some part is half at least (IoU)
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import tempfile

import numpy as np
from scipy.spatial import cKDTree

from solid_cells import (Grid, inside, material, outer_surface, read_mesh, sample,
                         solid)

def box(a, t, r=np.eye(3), e=(0.1, 0.1)):
    return {"semi_axes": list(a), "epsilon": list(e), "translation": np.array(t, float),
            "rotation": r, "leg": False}


def rod(foot, head, radius, square):
    """A leg between two places."""
    along = np.array(head) - np.array(foot)
    z = along / np.linalg.norm(along)
    x = np.cross([0.0, 1.0, 0.0], z)
    x /= np.linalg.norm(x)
    leg = box((radius, radius, np.linalg.norm(along) / 2), (np.array(foot) + head) / 2,
              np.stack([x, np.cross(z, x), z], 1), (0.1, 0.1 if square else 1.0))
    return {**leg, "leg": True}


def furniture(number):
    """A chair or a table, every fourth with a round top on three legs."""
    rng = np.random.default_rng([77, number])
    chair = number % 2 == 0
    width, depth = rng.uniform(.38, .5, 2) if chair else rng.uniform([.8, .5], [1.4, .9])
    height = rng.uniform(.4, .5) if chair else rng.uniform(.6, .8)
    thick, radius = rng.uniform(.015, .03), rng.uniform(.015, .03)
    round_top = number % 4 == 3
    if round_top:
        top = box((width / 2, width / 2, thick), (0, 0, height), e=(0.1, 1.0))
        places = [(.38 * width * np.cos(t), .38 * width * np.sin(t))
                  for t in np.arange(3) * 2 * np.pi / 3 + .2]
    else:
        top = box((width / 2, depth / 2, thick), (0, 0, height))
        places = [(x * (width / 2 - 1.5 * radius), y * (depth / 2 - 1.5 * radius))
                  for x in (-1, 1) for y in (-1, 1)]
    spread, square = rng.uniform(1.0, 1.15), rng.random() < .5
    parts = [top] + [rod((spread * x, spread * y, 0), (x, y, height), radius, square)
                     for x, y in places]
    if chair and rng.random() < .5:
        parts.append(box((width / 2, thick, rng.uniform(.18, .26)),
                         (0, depth / 2 - thick, height + .26)))
    elif chair:
        for x in (-1, 1):
            parts.append(rod((x * (width / 2 - radius), depth / 2 - radius, height),
                             (x * (width / 2 - radius), depth / 2 - radius, height + .45),
                             radius, square))
        parts.append(box((width / 2, thick, .07), (0, depth / 2 - radius, height + .4)))
    return parts


class Mesh:
    def __init__(self, path, up):
        self.name = path.stem
        self.triangles = read_mesh(path)
        self.cloud = self.triangles.ndim == 2
        corners = self.triangles.reshape(-1, 3)
        self.low, self.high = corners.min(0), corners.max(0)
        rng = np.random.default_rng(1)
        self.up, self.grid, self.parts = up, Grid(self.low, self.high), []
        if self.cloud:
            self.surface = self.triangles
            return
        self.material = material(self.triangles, self.grid)
        self.surface = sample(self.triangles, 200000, rng)
        self.solid = self.grid.filled(self.material, self.surface, up)
        self.surface = self.surface[self.grid.near_outside(self.solid, self.surface, 2)]

    def points(self, count, rng):
        if self.cloud:
            return self.triangles[rng.random(len(self.triangles)) < .9]
        return sample(self.triangles, count, rng)


class Furniture:
    cloud = False

    def __init__(self, number):
        self.name, self.parts, self.up = f"furniture{number}", furniture(number), 2
        self.surface = outer_surface(self.parts, 200000, np.random.default_rng(1))
        self.low, self.high = self.surface.min(0), self.surface.max(0)
        self.grid = Grid(self.low, self.high)
        self.solid = self.material = solid(self.parts, self.grid.points)

    def points(self, count, rng):
        return self.surface[rng.choice(len(self.surface), count, replace=False)]


def legs_found(truth, found):
    legs = [part for part in truth if part["leg"]]
    rng = np.random.default_rng(2)
    count = 0
    for leg in legs:
        size = 2 * np.linalg.norm(leg["semi_axes"])
        local = (rng.random((40000, 3)) - .5) * (2 * np.array(leg["semi_axes"]) + .1 * size)
        points = local @ leg["rotation"].T + leg["translation"]
        own = inside(leg, points)
        spot = np.prod(2 * np.array(leg["semi_axes"]) + .1 * size) / len(points)
        best = 0.0
        for part in found:
            both = (own & inside(part, points)).sum()
            # most of a part that is no leg lies outside of the leg's box
            bulk = np.prod(part["semi_axes"]) * 8 * .75
            best = max(best, both / (own.sum() + max(bulk / spot - both, 0)) if both else 0.0)
        count += best >= .5
    return count / len(legs)


def fit(program, points, options, folder):
    cloud, model = folder / "cloud.pcd", folder / "model.json"
    cloud.write_bytes(("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                       f"WIDTH {len(points)}\nHEIGHT 1\nPOINTS {len(points)}\nDATA binary\n"
                       ).encode() + points.astype("<f4").tobytes())
    model.unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run([program, cloud, "-o", model, "-q", "--threads", "1", *options],
                         capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if run.returncode != 0:
        return None, cpu, run.stderr.strip()
    return json.loads(model.read_text())["superquadrics"], cpu, ""


def judge(thing, points, parts):
    rng = np.random.default_rng(3)
    diagonal = np.linalg.norm(thing.high - thing.low)
    surface = outer_surface(parts, 200000, rng)
    score = {"parts": len(parts)}
    score["CD"] = 50 / diagonal * (
        cKDTree(thing.surface).query(surface[:8000])[0].mean() +
        cKDTree(surface).query(rng.permutation(thing.surface)[:8000])[0].mean())
    low, high = points.min(0), points.max(0)
    score["out"] = 100 * max((low - surface.min(0)).max(), (surface.max(0) - high).max(),
                             0) / (high - low).max()
    if not thing.cloud:
        for key, mine, theirs in (("IoU", solid(parts, thing.grid.points), thing.solid),
                                  ("IoUm", solid(parts, thing.grid.points, True),
                                   thing.material)):
            score[key] = (mine & theirs).sum() / max((mine | theirs).sum(), 1)
    if thing.parts:
        score["legs"] = legs_found(thing.parts, parts)
    return score


def line(name, scores):
    def mean(key, form):
        values = [s[key] for s in scores if key in s]
        return format(np.mean(values), form) if values else "-"
    counts = "/".join(str(s["parts"]) for s in scores) if len(scores) < 9 else mean("parts", ".1f")
    return (f"| {name:22s} | {mean('CD', '.2f'):>5s} | {mean('IoU', '.3f'):>5s} | "
            f"{mean('IoUm', '.3f'):>5s} | {counts:>8s} | {mean('CPU', '.2f'):>5s} | "
            f"{mean('out', '.1f'):>5s} | {mean('legs', '.2f'):>4s} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--furniture", type=int, nargs="*", default=[], metavar="N",
                        help="numbers of chairs (even) and tables (odd)")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1, 2])
    parser.add_argument("--points", type=int, default=5000)
    parser.add_argument("--up", choices="xyz", default="z", help="of the meshes")
    parser.add_argument("--json", type=pathlib.Path, help="all figures and models")
    own, _, options = list_split(os.sys.argv[1:])
    a = parser.parse_args(own)
    things = [lambda p=p: Mesh(p, "xyz".index(a.up)) for p in a.files]
    things += [lambda n=n: Furniture(n) for n in a.furniture]
    print("| object                 |   CD  |  IoU  |  IoUm |  parts   |  CPU  |  out  | legs |")
    print("|---|---|---|---|---|---|---|---|")
    every, kept = [], []
    for make in things:
        thing, scores = make(), []
        for seed in a.seeds:
            points = thing.points(a.points, np.random.default_rng([seed, 5]))
            with tempfile.TemporaryDirectory() as folder:
                parts, cpu, why = fit(a.bin / "pcl_sq_fit", points, options,
                                      pathlib.Path(folder))
            score = judge(thing, points, parts) if parts else {"parts": 0, "why": why}
            scores.append({**score, "CPU": cpu})
            kept.append({"name": thing.name, "seed": seed, **scores[-1], "model": parts})
        print(line(thing.name, scores), flush=True)
        every += scores
    print(line("mean", every))
    distances = [s["CD"] for s in every if "CD" in s]
    print(f"median CD {np.median(distances):.2f}, outside by > 5 % "
          f"{sum(s['out'] > 5 for s in every if 'out' in s)} of {len(every)}, "
          f"failed {sum('why' in s for s in every)}")
    if a.json:
        a.json.write_text(json.dumps(kept, default=float))


def list_split(arguments):
    """What stands before and after a lone --."""
    at = arguments.index("--") if "--" in arguments else len(arguments)
    return arguments[:at], "--", arguments[at + 1:]


if __name__ == "__main__":
    main()
