# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and unions of superquadrics as cells of a grid: what is solid, what is material."""
import struct

import numpy as np
from scipy import ndimage

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
