#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Looks at what scripts/demo.sh has left in demo/: a model that agrees with the truth, a
closed mesh, pictures that show something."""
import json
import os
import struct
import subprocess
import sys
import zlib
from collections import Counter

MIN_IOU = .93  # the bottle's two parts have .95 to .96 over textures and noise


def check(good, sentence):
    if not good:
        sys.exit("check_demo.py: " + sentence)


def triangles(path):
    """Corners of each triangle of an ASCII or binary PLY file, by place in space."""
    data = open(path, "rb").read()
    head, body = data.split(b"end_header\n", 1)
    lines = head.decode().split("\n")
    counts = {l.split()[1]: int(l.split()[2]) for l in lines if l.startswith("element")}
    part, layout = "", ""
    codes = {"float": "f", "double": "d", "uchar": "B"}
    for line in lines:
        words = line.split()
        if words[:1] == ["element"]:
            part = words[1]
        elif words[:1] == ["property"] and part == "vertex":
            layout += codes[words[1]]
    if "format ascii" in head.decode():
        rows = body.decode().split("\n")
        places = [tuple(r.split()[:3]) for r in rows[:counts["vertex"]]]
        faces = [[int(w) for w in r.split()[1:]]
                 for r in rows[counts["vertex"]:][:counts["face"]]]
    else:
        row = struct.Struct("<" + layout)
        places = [row.unpack_from(body, i * row.size)[:3] for i in range(counts["vertex"])]
        at, faces = counts["vertex"] * row.size, []
        for _ in range(counts["face"]):
            faces.append(struct.unpack_from("<%di" % body[at], body, at + 1))
            at += 1 + 4 * body[at]
    return [[places[i] for i in face] for face in faces]


def colours(path):
    """Number of different bytes in a PNG's lines: a blank picture has a handful."""
    data, pixels, at = open(path, "rb").read(), b"", 8
    check(data[:8] == b"\x89PNG\r\n\x1a\n", path + " is no PNG")
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            pixels += data[at + 8:at + 8 + length]
        at += 12 + length
    return len(set(zlib.decompress(pixels)))


os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
model = json.load(open("demo/model.json"))
check(model["schema"] == "pcl_sq/model" and model["superquadrics"], "no superquadric")
evaluate = os.path.join(os.environ.get("PCL_SQ_BUILD_DIR", "build"), "bin/pcl_sq_evaluate")
judged = subprocess.run([evaluate, "demo/model.json",
                         "--truth", "demo/scene/truth.json"],
                        check=True, capture_output=True, text=True)
iou = json.loads(judged.stdout)["shape"]["iou"]
check(iou >= MIN_IOU, "IoU with the truth is %.3f, less than %.2f" % (iou, MIN_IOU))

faces = triangles("demo/mesh.ply")
check(len(faces) >= 100, "mesh.ply has %d triangles" % len(faces))
edges = Counter((f[i], f[(i + 1) % len(f)]) for f in faces for i in range(len(f)))
check(all(n == edges[(b, a)] for (a, b), n in edges.items()), "mesh.ply is not closed")

for picture in ("demo/picture.png", "demo/panel.png"):
    check(colours(picture) >= 64, picture + " is blank")
print("demo: IoU %.3f, closed mesh of %d triangles, two pictures" % (iou, len(faces)))
