#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the tutorials' pictures with the programs of a build: pictures.py BUILD_DIR FOLDER.

The inputs are a rendered pair of a mug, and a table with three things as a depth camera would
see it, which this script computes."""
import os
import subprocess
import sys
import tempfile

import numpy as np

build, target = (os.path.abspath(p) for p in sys.argv[1:3])
sys.path.insert(0, os.path.join(build, "python"))
import pcl_sq  # noqa: E402

WIDTH, HEIGHT, F = 640, 480, 600.0
PITCH, LIFT = np.radians(28), 0.45  # of a camera that looks down on a table [m]


def on_table(semi_axes, epsilon, x, ahead, turn=0.0, **more):
    """A superquadric that stands on the table, in the camera's frame."""
    up = np.array([0, -np.cos(PITCH), -np.sin(PITCH)])
    forward = np.array([0, -np.sin(PITCH), np.cos(PITCH)])
    side = np.cross(forward, up)
    center = -LIFT * up + x * np.array([1, 0, 0]) + ahead * forward + semi_axes[2] * up
    axes = np.stack([np.cos(turn) * side + np.sin(turn) * forward,
                     np.cos(turn) * forward - np.sin(turn) * side, up], axis=1)
    axes[:, 1] = np.cross(axes[:, 2], axes[:, 0])
    return pcl_sq.Superquadric(semi_axes, epsilon=epsilon, center=center, rotation=axes, **more)


def look(things, colors):
    """(points, colours) of each pixel: each ray goes on by the distance to what is nearest."""
    u, v = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    rays = np.dstack([(u - WIDTH / 2) / F, (v - HEIGHT / 2) / F, np.ones(u.shape)])
    long = np.linalg.norm(rays, axis=2)
    down = rays[..., 1] * np.cos(PITCH) + np.sin(PITCH)
    depth = np.where(down > 1e-3, LIFT / np.maximum(down, 1e-3), np.nan)
    image = np.tile(np.array([150, 135, 115.0]), (HEIGHT, WIDTH, 1))
    for thing, color in zip(things, colors):
        z = np.full(u.shape, np.linalg.norm(thing.center) - 0.25)
        for _ in range(50):
            z = z + 0.8 * thing.distance(rays * z[..., None], method="fast") / long
        hit = (np.abs(thing.distance(rays * z[..., None], method="fast")) < 5e-4) & (z < depth)
        depth[hit] = z[hit]
        light = -np.sum(thing.normal(rays[hit] * z[hit][:, None]) * rays[hit], axis=1)
        image[hit] = np.array(color) * (0.35 + 0.65 * np.clip(light / long[hit], 0, 1))[:, None]
    depth[~(depth < 1.5)] = np.nan
    depth += np.random.default_rng(0).normal(0, 0.0006, depth.shape)
    return (rays * depth[..., None]).astype("<f4"), image.astype(np.uint8)


def write_pcd(path, points, colors):
    """An organized cloud with colours."""
    packed = (colors[..., 0].astype("<u4") << 16) | (colors[..., 1].astype("<u4") << 8) | \
        colors[..., 2]
    rows = np.concatenate([points.view("<u4"), packed[..., None]], axis=2)
    with open(path, "wb") as out:
        out.write(("VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
                   "WIDTH %d\nHEIGHT %d\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA binary\n" % (
                       WIDTH, HEIGHT, WIDTH * HEIGHT)).encode())
        out.write(np.ascontiguousarray(rows).tobytes())


def run(program, *words):
    subprocess.run([os.path.join(build, "bin", program)] + [str(w) for w in words] + ["-q"],
                   check=True)


os.makedirs(target, exist_ok=True)
can = on_table([0.033, 0.033, 0.06], (0.1, 1.0), 0.0, 0.62)
box = on_table([0.05, 0.03, 0.08], (0.1, 0.1), -0.14, 0.66, turn=0.5)
cup = on_table([0.045, 0.045, 0.04], (0.15, 1.0), 0.14, 0.58, taper=(0.2, 0.2))
with tempfile.TemporaryDirectory() as folder:
    scene, one, pair = folder + "/scene.pcd", folder + "/one.pcd", folder + "/mug"
    write_pcd(scene, *look([can, box, cup], [(190, 60, 50), (70, 110, 180), (80, 150, 90)]))
    write_pcd(one, *look([can], [(190, 60, 50)]))
    run("pcl_sq_scene", scene, "--panel", target + "/scene.png")
    run("pcl_sq_fit", one, "--remove-plane", "-o", folder + "/can.json", "--snapshot",
        target + "/depth_camera.png")
    run("pcl_sq_render", "cup", "--pitch", "30", "--out", pair)
    run("pcl_sq_stereo", pair + "/left.png", pair + "/right.png", "--calib",
        pair + "/calib.yml", "--panel", target + "/stereo.png", "--cloud", folder + "/cup.pcd",
        "-o", folder + "/cup.json")
    run("pcl_sq_grasp", folder + "/cup.json", "--cloud", folder + "/cup.pcd", "-o",
        folder + "/grasps.json", "--snapshot", target + "/grasps.png")
