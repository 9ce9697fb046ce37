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
import struct
import subprocess
import tempfile

import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

CELLS = 112  # of the grid's longest side


def read_mesh(path):
    """Corners of the triangles (n, 3, 3); of a cloud, no triangles but its points (n, 3)."""
    if path.suffix == ".stl":
        data = path.read_bytes()
        count = struct.unpack("<I", data[80:84])[0]
        record = np.frombuffer(data[84:84 + 50 * count],
                               np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]))
        return record["v"].astype(float)
    if path.suffix == ".ply":
        head, body = path.read_text().split("end_header\n")
        return np.array([line.split()[:3] for line in body.splitlines() if line.strip()], float)
    vertices, faces = [], []
    for line in path.read_text().splitlines():
        word = line.split()
        if word and word[0] == "v":
            vertices.append([float(x) for x in word[1:4]])
        elif word and word[0] == "f":
            index = [int(w.split("/")[0]) for w in word[1:]]
            index = [i - 1 if i > 0 else len(vertices) + i for i in index]
            faces += [[index[0], index[i], index[i + 1]] for i in range(1, len(index) - 1)]
    return np.array(vertices)[np.array(faces)]


def sample(triangles, count, rng):
    area = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0],
                                   triangles[:, 2] - triangles[:, 0]), axis=1)
    chosen = triangles[rng.choice(len(area), count, p=area / area.sum())]
    u, v = rng.random((2, count, 1))
    flip = u + v > 1
    u, v = np.where(flip, 1 - u, u), np.where(flip, 1 - v, v)
    return chosen[:, 0] + u * (chosen[:, 1] - chosen[:, 0]) + v * (chosen[:, 2] - chosen[:, 0])


class Grid:
    """Cells about a box, larger by a sixth of its diagonal."""

    def __init__(self, low, high):
        margin = np.linalg.norm(high - low) / 6
        self.low, self.high = low - margin, high + margin
        self.step = (self.high - self.low).max() / CELLS
        self.axes = [np.arange(self.low[k], self.high[k], self.step) for k in range(3)]
        self.shape = tuple(len(a) for a in self.axes)
        self.points = np.stack(np.meshgrid(*self.axes, indexing="ij"), -1).reshape(-1, 3)

    def cells(self, points):
        at = np.clip(np.round((points - self.low) / self.step).astype(int), 0,
                     np.array(self.shape) - 1)
        return tuple(at.T)

    def filled(self, solid, surface, up):
        """What its horizontal sections enclose is added; walls may be thinner than a cell."""
        solid = solid.reshape(self.shape)
        wall = np.zeros(self.shape, bool)
        wall[self.cells(surface)] = True
        filled = np.moveaxis(solid | wall, up, 0)
        for layer in filled:
            ndimage.binary_fill_holes(layer, output=layer)
        filled = np.moveaxis(filled, 0, up)
        # cells that the surface only touches are outside where they are next to it
        rim = filled & ~solid & ndimage.binary_dilation(~filled)
        return (filled & ~rim).reshape(-1)

    def near_outside(self, solid, points, cells):
        """Which points have a place outside of a solid within some cells."""
        wide = ndimage.binary_dilation(~solid.reshape(self.shape), iterations=cells)
        return wide[self.cells(points)]


def material(triangles, grid):
    """Cells in a closed mesh or a union of them: winding numbers along z."""
    nudge = 1e-5 * grid.step * np.array([1.0, np.pi / 3, 0.0])
    turns = np.zeros(grid.shape, int)
    for a, b, c in (triangles - grid.low - nudge) / grid.step:
        normal = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        if abs(normal) < 1e-12:
            continue
        low = np.ceil(np.minimum(np.minimum(a, b), c)).astype(int)
        high = np.floor(np.maximum(np.maximum(a, b), c)).astype(int)
        if low[0] > high[0] or low[1] > high[1]:
            continue
        x, y = np.mgrid[low[0]:high[0] + 1, low[1]:high[1] + 1]
        u = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / normal
        v = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / normal
        hit = (u >= 0) & (v >= 0) & (u + v <= 1)
        z = a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2])
        above = np.ceil(z[hit]).astype(int)
        np.add.at(turns, (x[hit], y[hit], np.clip(above, 0, grid.shape[2] - 1)),
                  int(np.sign(normal)))
    return (np.cumsum(turns, axis=2) != 0).reshape(-1)


def bend(local, part):
    kappa, angle = part.get("bend", [0, 0])
    if abs(kappa) < 1e-9:
        return local
    c, s, r = np.cos(angle), np.sin(angle), 1 / kappa
    x, y = c * local[:, 0] + s * local[:, 1], c * local[:, 1] - s * local[:, 0]
    z = (r - x) * np.sin(local[:, 2] / r)
    x = r - (r - x) * np.cos(local[:, 2] / r)
    return np.stack([c * x - s * y, s * x + c * y, z], 1)


def unbend(local, part):
    kappa, angle = part.get("bend", [0, 0])
    if abs(kappa) < 1e-9:
        return local
    c, s, r = np.cos(angle), np.sin(angle), 1 / kappa
    x, y = c * local[:, 0] + s * local[:, 1], c * local[:, 1] - s * local[:, 0]
    away = np.sign(r) * np.hypot(r - x, local[:, 2])
    z = r * np.arctan2(np.sign(r) * local[:, 2], np.sign(r) * (r - x))
    return np.stack([c * (r - away) - s * y, s * (r - away) + c * y, z], 1)


def inside(part, points, hollow=False, tolerance=0.0):
    """Of a part of a model file; \a hollow: whether its hollow is outside."""
    a, (e1, e2) = np.array(part["semi_axes"]), part["epsilon"]
    local = (points - part["translation"]) @ np.array(part["rotation"])
    reach = 1.5 * np.linalg.norm(a) if "bend" not in part else np.inf
    near = (local ** 2).sum(1) < reach ** 2
    local = unbend(local[near], part)
    z = local[:, 2] / a[2]
    k = part.get("taper", [0, 0])
    scale = np.maximum(1 - np.minimum(np.abs(z), 1) ** (2 / e1), 0) ** (e1 / 2)
    grown = [np.maximum(1 + k[i] * np.clip(z, -1, 1), 1e-6) * scale * a[i] for i in (0, 1)]

    def within(shrink):
        x, y = (np.abs(local[:, i]) / np.maximum(grown[i] - shrink, 1e-12) for i in (0, 1))
        return np.maximum(x, y) * (1 + (np.minimum(x, y) / np.maximum(np.maximum(x, y), 1e-300))
                                   ** (2 / e2)) ** (e2 / 2) <= 1
    body = within(tolerance) & (z <= part.get("rim", 1.0)) & (np.abs(z) <= 1)
    if hollow and part.get("wall", 0) > 0:
        body &= ~(within(part["wall"]) & (z > part["wall"] / a[2] - 1))
    result = np.zeros(len(points), bool)
    result[near] = body
    return result


def solid(parts, points, hollow=False):
    result = np.zeros(len(points), bool)
    for part in parts:
        result |= inside(part, points, hollow)
    return result


def outer_surface(parts, count, rng):
    """Points spread evenly over the outside of a union, lids of open bodies left out."""
    places, areas, owner = [], [], []
    for number, part in enumerate(parts):
        a, (e1, e2) = np.array(part["semi_axes"]), part["epsilon"]
        k, rim = part.get("taper", [0, 0]), part.get("rim", 1.0)
        # equal steps of the superellipses' length, near enough
        def curve(e, low):
            t = np.linspace(low, np.pi / 2, 20001)
            p = np.stack([np.cos(t).clip(0) ** e, np.sign(np.sin(t)) * np.abs(np.sin(t)) ** e], 1)
            way = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
            at = np.linspace(0, way[-1], 81)
            return np.stack([np.interp(at, way, p[:, i]) for i in (0, 1)], 1)
        meridian, quarter = curve(e1, -np.pi / 2), curve(e2, 0)
        round_ = np.concatenate([quarter, quarter[-2::-1] * [-1, 1]])
        round_ = np.concatenate([round_, round_[-2::-1] * [1, -1]])
        z = np.minimum(meridian[:, 1], rim)[:, None]
        width = np.where(meridian[:, 1] <= rim, meridian[:, 0],
                         max(1 - min(abs(rim), 1) ** (2 / e1), 0) ** (e1 / 2))[:, None]
        mesh = np.stack([a[0] * (1 + k[0] * z) * width * round_[:, 0],
                         a[1] * (1 + k[1] * z) * width * round_[:, 1],
                         a[2] * z + 0 * round_[:, 0]], -1)
        mesh = bend(mesh.reshape(-1, 3), part).reshape(mesh.shape)
        mesh = mesh @ np.array(part["rotation"]).T + part["translation"]
        corner, right, up = mesh[:-1, :-1], mesh[:-1, 1:], mesh[1:, :-1]
        other = mesh[1:, 1:]
        for triangle in (np.stack([corner, right, up], -2), np.stack([other, right, up], -2)):
            t = triangle.reshape(-1, 3, 3)
            places.append(t)
            owner.append(np.full(len(t), number))
    triangles, owner = np.concatenate(places), np.concatenate(owner)
    areas = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0],
                                    triangles[:, 2] - triangles[:, 0]), axis=1)
    index = rng.choice(len(areas), 3 * count, p=areas / areas.sum())
    u, v = rng.random((2, len(index), 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    t = triangles[index]
    points = t[:, 0] + u * (t[:, 1] - t[:, 0]) + v * (t[:, 2] - t[:, 0])
    shown = np.ones(len(points), bool)
    for number, part in enumerate(parts):
        shown &= (owner[index] == number) | ~inside(part, points)
    return points[shown][:count]


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
