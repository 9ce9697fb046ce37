#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Single-view scenes of tapered bodies: pots, lampshades and tubs on a table.

usage: taper_scenes.py GENERATORS OUT [COUNT=30]      (environment: SEED)

GENERATORS holds gen_scene.py, whose camera, table, noise and files are used; each part of
truth.json has its taper as "k": [kx, ky] besides.
"""
import json
import os
import sys

import numpy as np

generators, out = sys.argv[1:3]
count = int(sys.argv[3]) if len(sys.argv) > 3 else 30
sys.path.insert(0, generators)
import gen_scene as scenes  # noqa: E402
import sqlib  # noqa: E402

taper = None  # of the scene that is being made


def shape(kind, random):
    """Instead of gen_scene's: one body, its section growing upwards, downwards or both
    its sides by different amounts."""
    global taper
    u = random.uniform
    half = u(.04, .09)
    name = ("pot", "shade", "tub")[kind % 3]
    if name == "tub":
        a, e = (u(.03, .06), u(.03, .06), half), (u(.1, .3), u(.1, .3))
        taper = (u(.1, .4), u(.1, .4))
    else:
        r = u(.03, .055)
        a, e = (r, r, half), (u(.1, .4), 1.0)
        k = u(.15, .45)
        taper = (k, k) if name == "pot" else (-k, -k)
    return name, [dict(a=np.array(a), e=list(e), R=np.eye(3), t=np.array([0, 0, half]))]


def first_hit(part, d):
    """Depth along unit-z rays of the entry: the first of 400 places inside, refined."""
    a3 = part["a"][2]

    def gauge(s):
        local = (d[None] * s[..., None] - part["t"]) @ part["R"]
        for axis in (0, 1):
            local[..., axis] /= np.maximum(1 + taper[axis] * local[..., 2] / a3, .05)
        flat = local.reshape(-1, 3)
        return sqlib.F_pow(flat, part["a"], part["e"]).reshape(local.shape[:-1])

    r = np.linalg.norm(part["a"] * (1 + max(np.abs(taper))))
    mid = (d @ part["t"]) / (d * d).sum(1)
    places = mid + np.linspace(-r, r, 400)[:, None]
    inside = gauge(places) < 1
    hit = inside.any(0)
    first = np.argmax(inside, 0)
    lo = np.take_along_axis(places, np.maximum(first - 1, 0)[None], 0)[0]
    hi = np.take_along_axis(places, first[None], 0)[0]
    for _ in range(40):
        middle = (lo + hi) / 2
        within = gauge(middle[None])[0] < 1
        hi, lo = np.where(within, middle, hi), np.where(within, lo, middle)
    return np.where(hit, hi, np.inf)


scenes.shape, scenes.first_hit = shape, first_hit
for i in range(count):
    folder = os.path.join(out, str(i))
    scenes.scene(i, folder)
    path = os.path.join(folder, "truth.json")
    with open(path) as file:
        truth = json.load(file)
    truth["parts"][0]["k"] = [float(k) for k in taper]
    with open(path, "w") as file:
        json.dump(truth, file)
