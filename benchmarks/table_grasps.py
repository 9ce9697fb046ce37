#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Grasps of household things planned from one view, checked on their true meshes.

usage: table_grasps.py BIN SCENES... [--gripper franka_hand] [--out FOLDER] [--verbose]

BIN holds pcl_sq_fit and pcl_sq_grasp, SCENES what `gen_table.py SCENES --objects 1` writes. Each
thing is fitted with its exact mask and grasps are planned with the whole cloud around it.
A grasp is antipodal where the two jaws, closing from where they stand open, first meet the mesh
on surfaces whose normals lie in the friction cones about the closing line; it is free where
neither the true surface nor the table reaches into the hand's boxes, open, at the grasp and
along the last 10 cm of the approach. Of each thing the best grasp, and the best ones on a rim
(across the wall of an open part) and on a bent part (a handle).
"""
import argparse
import collections
import json
import pathlib
import subprocess
import tempfile

import numpy as np

SAMPLES = 30000
RETREAT = 0.10  # [m], as the planner's own
KINDS = ("rim", "handle", "body")


def read_obj(path):
    vertices, triangles = [], []
    for line in path.read_text().splitlines():
        word = line.split()
        if word and word[0] == "v":
            vertices.append([float(x) for x in word[1:4]])
        elif word and word[0] == "f":
            triangles.append([int(x.split("/")[0]) - 1 for x in word[1:4]])
    return np.array(vertices), np.array(triangles)


class Truth:
    """The true surface of one thing and its table, in the camera's frame."""

    def __init__(self, folder, truth):
        thing = truth["objects"][0]
        vertices, triangles = read_obj(folder / thing["mesh"])
        pose = np.array(thing["T"]).reshape(4, 4)
        self.corners = (vertices @ pose[:3, :3].T + pose[:3, 3])[triangles]
        self.table = np.array(truth["table"])
        a, b, c = (self.corners[:, k] for k in range(3))
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        random = np.random.default_rng(7)
        pick = random.choice(len(areas), SAMPLES, p=areas / areas.sum())
        u, v = random.random((2, SAMPLES))
        u, v = np.where(u + v > 1, [1 - u, 1 - v], [u, v])
        self.samples = a[pick] + u[:, None] * (b - a)[pick] + v[:, None] * (c - a)[pick]

    def cast(self, origin, direction):
        """First hit: distance and the normal against the ray; None where nothing is met."""
        a, b, c = (self.corners[:, k] for k in range(3))
        ab, ac, s = b - a, c - a, origin - a
        p = np.cross(direction, ac)
        with np.errstate(divide="ignore", invalid="ignore"):
            det = (ab * p).sum(1)
            u = (s * p).sum(1) / det
            q = np.cross(s, ab)
            v, at = q @ direction / det, (ac * q).sum(1) / det
        hit = (np.abs(det) > 1e-18) & (u >= 0) & (v >= 0) & (u + v <= 1) & (at >= 0)
        if not hit.any():
            return None
        k = np.flatnonzero(hit)[np.argmin(at[hit])]
        normal = np.cross(ab[k], ac[k])
        normal /= np.linalg.norm(normal)
        return at[k], -normal if normal @ direction > 0 else normal

    def is_antipodal(self, grasp, friction):
        y, width = np.array(grasp["closing"]), grasp["open_width"]
        middle = np.mean([c["position"] for c in grasp["contacts"]], axis=0)
        hits = [self.cast(middle + sign * 0.5 * width * y, -sign * y) for sign in (1, -1)]
        if None in hits or hits[0][0] + hits[1][0] >= width:
            return False
        least = 1.0 / np.hypot(1.0, friction)
        return hits[0][1] @ y >= least and hits[1][1] @ -y >= least

    def is_free(self, grasp, gripper):
        frame, place = np.array(grasp["rotation"]), np.array(grasp["position"])
        tip = 0.5 * gripper["pad_length"]
        palm = tip - gripper["finger_length"]
        out = 0.5 * (grasp["open_width"] + gripper["finger_thickness"])
        finger = [gripper[k] for k in ("finger_width", "finger_thickness", "finger_length")]
        hand = [gripper[k] for k in ("palm_depth", "palm_width", "palm_height")]
        boxes = [((0, sign * out, 0.5 * (tip + palm)), finger) for sign in (1, -1)]
        boxes.append(((0, 0, palm - 0.5 * gripper["palm_height"]), hand))
        for back in (0.0, 0.2, 0.5, 1.0):
            away = place - back * RETREAT * frame[:, 2]
            local = (self.samples - away) @ frame
            height = self.table[:3] @ away + self.table[3]
            up = frame.T @ self.table[:3]
            for centre, sizes in boxes:
                if height + up @ centre - 0.5 * np.abs(up) @ sizes < 0.0:
                    return False
                if (np.abs(local - centre) <= 0.5 * np.array(sizes)).all(1).any():
                    return False
        return True


def kind_of(grasp, parts):
    first, second = (parts[c["part"]] for c in grasp["contacts"])
    if first is second and "wall" in first and grasp["width"] < 4.0 * first["wall"]:
        return "rim"
    return "handle" if "bend" in first and "bend" in second else "body"


def plan(binaries, folder, truth, out, gripper):
    camera = truth["camera"]
    model, grasps = out / "model.json", out / "grasps.json"
    commands = ([binaries / "pcl_sq_fit", folder / "cloud.pcd", "--mask",
                 folder / "labels.png", "--intrinsics",
                 "{f},{f},{cx},{cy}".format(**camera), "-o", model, "--threads", "1", "-q"],
                [binaries / "pcl_sq_grasp", model, "--cloud", folder / "cloud.pcd", "--count",
                 "100", "--gripper", gripper, "-o", grasps, "-q"])
    for command in commands:
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
        if done.returncode != 0:
            return None, done.stderr.strip()
    return json.loads(grasps.read_text()), json.loads(model.read_text())["superquadrics"]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("scenes", type=pathlib.Path, nargs="+")
    parser.add_argument("--gripper", default="franka_hand")
    parser.add_argument("--out", type=pathlib.Path, help="keeps the models and grasps here")
    parser.add_argument("--verbose", action="store_true")
    args = parser.parse_args()
    rows = collections.defaultdict(list)
    folders = [f for s in args.scenes
               for f in sorted((p.parent for p in s.glob("*/truth.json")),
                               key=lambda f: int(f.name))]
    for number, folder in enumerate(folders):
        truth = json.loads((folder / "truth.json").read_text())
        name = truth["objects"][0]["name"]
        with tempfile.TemporaryDirectory() as scratch:
            out = args.out / str(number) if args.out else pathlib.Path(scratch)
            out.mkdir(parents=True, exist_ok=True)
            found, parts = plan(args.binaries, folder, truth, out, args.gripper)
        rows[name].append(None)
        if found is None:
            if args.verbose:
                print(f"{folder} {name}: {parts}")
            continue
        mesh, best = Truth(folder, truth), {}
        for rank, grasp in enumerate(found["grasps"]):
            kind = kind_of(grasp, parts)
            for key in ({"best", kind} if rank == 0 else {kind}) - set(best):
                best[key] = (mesh.is_antipodal(grasp, found["friction"]),
                             mesh.is_free(grasp, found["gripper"]), rank + 1)
        rows[name][-1] = best
        if args.verbose:
            print(f"{folder} {name}:", ", ".join(
                f"{key} {'antipodal' if v[0] else 'SLIPS'} {'free' if v[1] else 'HITS'}"
                f" (rank {v[2]})" for key, v in sorted(best.items())))
    rows["all"] = [r for values in list(rows.values()) for r in values]
    print("thing    things planned | antipodal / free [%], number: best of each thing" +
          "".join(f" | {kind}" for kind in KINDS))
    for name, values in rows.items():
        text = f"{name:10s} {len(values):4d} {sum(v is not None for v in values):7d}"
        for key in ("best",) + KINDS:
            got = [v[key] for v in values if v and key in v]
            text += " | " + (f"{100 * np.mean([g[0] for g in got]):5.1f} "
                             f"{100 * np.mean([g[1] for g in got]):5.1f} {len(got):3d}"
                             if got else " " * 15)
        print(text)


if __name__ == "__main__":
    main()
