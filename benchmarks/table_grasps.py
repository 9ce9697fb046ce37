#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Grasps of household things planned from one view, checked on their true meshes.

usage: table_grasps.py BIN SCENES... [--gripper franka_hand] [--out FOLDER] [--verbose]

BIN holds pcl_sq_fit, pcl_sq_scene and pcl_sq_grasp, SCENES what `gen_table.py SCENES` writes: a
thing alone is fitted with its exact mask, several with their exact labels. Grasps are planned with
the whole cloud and the models of the other things around.
A grasp is antipodal where the two jaws, closing from where they stand open, first meet the mesh
on surfaces whose normals lie in the friction cones about the closing line; it is free where
neither a true surface nor the table reaches into the hand's boxes, open, at the grasp and
along the last 10 cm of the approach. Of each thing seen by 30 % or more the best grasp, and the
best ones on a rim (across the wall of an open part) and on a bent part (a handle).
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


def surface(corners):
    a, b, c = (corners[:, k] for k in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(7)
    pick = random.choice(len(areas), SAMPLES, p=areas / areas.sum())
    u, v = random.random((2, SAMPLES))
    u, v = np.where(u + v > 1, [1 - u, 1 - v], [u, v])
    return a[pick] + u[:, None] * (b - a)[pick] + v[:, None] * (c - a)[pick]


def corners_of(folder, thing):
    vertices, triangles = read_obj(folder / thing["mesh"])
    pose = np.array(thing["T"]).reshape(4, 4)
    return (vertices @ pose[:3, :3].T + pose[:3, 3])[triangles]


class Truth:
    """The true surfaces of one thing, of the others and the table, in the camera's frame."""

    def __init__(self, corners, others, table):
        self.corners, self.table = corners, np.array(table)
        self.samples = surface(corners)
        self.others = np.concatenate([surface(o) for o in others]) if others else None

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

    def hits(self, grasp, gripper):
        """What the open hand runs into: a word, or None."""
        frame, place = np.array(grasp["rotation"]), np.array(grasp["position"])
        tip = 0.5 * gripper["pad_length"]
        palm = tip - gripper["finger_length"]
        out = 0.5 * (grasp["open_width"] + gripper["finger_thickness"])
        finger = [gripper[k] for k in ("finger_width", "finger_thickness", "finger_length")]
        hand = [gripper[k] for k in ("palm_depth", "palm_width", "palm_height")]
        boxes = [((0, sign * out, 0.5 * (tip + palm)), finger) for sign in (1, -1)]
        boxes.append(((0, 0, palm - 0.5 * gripper["palm_height"]), hand))
        up = frame.T @ self.table[:3]
        for back in (0.0, 0.2, 0.5, 1.0):
            away = place - back * RETREAT * frame[:, 2]
            height = self.table[:3] @ away + self.table[3]
            for centre, sizes in boxes:
                if height + up @ centre - 0.5 * np.abs(up) @ sizes < 0.0:
                    return "the table"
            for word, samples in (("itself", self.samples), ("another", self.others)):
                if samples is None:
                    continue
                local = (samples - away) @ frame
                for centre, sizes in boxes:
                    if (np.abs(local - centre) <= 0.5 * np.array(sizes)).all(1).any():
                        return word
        return None


def kind_of(grasp, parts):
    first, second = (parts[c["part"]] for c in grasp["contacts"])
    if first is second and "wall" in first and grasp["width"] < 4.0 * first["wall"]:
        return "rim"
    return "handle" if "bend" in first and "bend" in second else "body"


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    return done.stderr.strip() if done.returncode != 0 else None


def roi_of(thing):
    x, y, w, h = thing["roi"]
    return np.array([x, y, x + w, y + h])


def models_of(binaries, folder, truth, out):
    """Fits a scene: the file of the models, and of each true thing the number of its model
    among them and its parts; None where there is none."""
    camera, number = truth["camera"], len(truth["objects"])
    model = out / "model.json"
    failed = run(binaries / ("pcl_sq_fit" if number == 1 else "pcl_sq_scene"),
                 folder / "cloud.pcd", "--mask" if number == 1 else "--labels",
                 folder / "labels.png", "--intrinsics",
                 "{f},{f},{cx},{cy}".format(**camera), "-o", model, "--threads", "1", "-q")
    if failed:
        return model, [None] * number
    read = json.loads(model.read_text())
    if number == 1:
        return model, [(0, read["superquadrics"])]
    found = []
    for thing in truth["objects"]:
        away = [np.abs(roi_of(o) - roi_of(thing)).max() for o in read["objects"]]
        k = int(np.argmin(away)) if away else 0
        found.append((k + 1, read["objects"][k]["superquadrics"])
                     if away and away[k] <= 3 else None)
    return model, found


def plan(binaries, folder, model, thing, gripper, out):
    """The grasps of one thing, or why there are none."""
    if thing is None:
        return None, "no model"
    grasps = out / f"grasps{thing[0]}.json"
    failed = run(binaries / "pcl_sq_grasp", model, "--cloud", folder / "cloud.pcd", "--count",
                 "100", "--gripper", gripper, "-o", grasps, "-q",
                 *(["--object", thing[0]] if thing[0] else []))
    return (None, failed) if failed else (json.loads(grasps.read_text()), None)


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
        corners = [corners_of(folder, thing) for thing in truth["objects"]]
        with tempfile.TemporaryDirectory() as scratch:
            out = args.out / str(number) if args.out else pathlib.Path(scratch)
            out.mkdir(parents=True, exist_ok=True)
            model, things = models_of(args.binaries, folder, truth, out)
            for k, true_thing in enumerate(truth["objects"]):
                if true_thing["visible"] < 0.3:
                    continue
                name = true_thing["name"]
                found, why = plan(args.binaries, folder, model, things[k], args.gripper, out)
                rows[name].append(None)
                if found is None:
                    if args.verbose:
                        print(f"{folder} {k + 1} {name}: {why}")
                    continue
                mesh = Truth(corners[k], corners[:k] + corners[k + 1:], truth["table"])
                best = {}
                for rank, grasp in enumerate(found["grasps"]):
                    kind = kind_of(grasp, things[k][1])
                    for key in ({"best", kind} if rank == 0 else {kind}) - set(best):
                        hit = mesh.hits(grasp, found["gripper"])
                        best[key] = (mesh.is_antipodal(grasp, found["friction"]), hit is None,
                                     rank + 1, hit)
                rows[name][-1] = best
                if args.verbose:
                    print(f"{folder} {k + 1} {name}:", ", ".join(
                        f"{key} {'antipodal' if v[0] else 'SLIPS'} "
                        f"{'free' if v[1] else 'HITS ' + v[3]} (rank {v[2]})"
                        for key, v in sorted(best.items())))
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
