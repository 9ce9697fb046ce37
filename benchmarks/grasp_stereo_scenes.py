#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes scenes for grasp_evaluation.py from stereo pairs, through the whole chain.

usage: grasp_stereo_scenes.py BIN OUT [--seeds 1 2 3] [--pairs FOLDER] [--matcher sgbm]

BIN holds pcl_sq_render and pcl_sq_stereo. Objects are rendered with several turns,
textures and noises; what is known of them afterwards comes from the two images alone:
OUT/<scene>/fit.json and object.pcd, beside truth.json. FOLDER may hold further pairs, one
folder each with rect_left.png, rect_right.png, calib_rect.yml and gt.yml (mesh, pose, ROI).
"""
import argparse
import json
import pathlib
import random
import re
import subprocess

OBJECTS = ("bottle", "cup", "book", "box", "can", "tomato", "bowl")


def numbers(text, name):
    block = re.search(name + r":.*?data: \[(.*?)\]", text, re.S).group(1)
    return [float(x) for x in block.split(",")]


def truth_of_pair(folder):
    text = (folder / "gt.yml").read_text()
    pose = numbers(text, "T_mesh_to_rectleft")
    mesh = folder / re.search(r'mesh: "(.*?)"', text).group(1)
    return {"mesh": str(mesh.resolve()), "table": numbers(text, "table_plane_rectleft"),
            "pose": {"rotation": [pose[0:3], pose[4:7], pose[8:11]],
                     "translation": [pose[3], pose[7], pose[11]]},
            "roi": [int(x) for x in numbers(text, "roi_rect_xywh")]}


def fit(program, out, left, right, calib, roi, matcher):
    # a hand-drawn box: a little larger than the object
    x, y, width, height = roi
    box = [x - 4, y - 4, width + 8, height + 8]
    done = subprocess.run(
        [program, left, right, "--calib", calib, "--roi", ",".join(map(str, box)), "--matcher",
         matcher, "-o", out / "fit.json", "--object-cloud", out / "object.pcd", "-q"],
        capture_output=True, text=True)
    print(out.name, "fitted" if done.returncode == 0 else done.stderr.strip(), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, nargs="*", default=[1, 2, 3])
    parser.add_argument("--pairs", type=pathlib.Path)
    parser.add_argument("--matcher", default="sgbm")
    args = parser.parse_args()
    for seed in args.seeds:
        for name in OBJECTS:
            draw = random.Random(f"{name} {seed}")
            scene = args.out / f"{name}_{seed}"
            subprocess.run(
                [args.bin / "pcl_sq_render", name, "--out", scene, "--rig", "vga", "--seed",
                 str(seed), "--distance", f"{draw.uniform(.7, 1.1):.3f}", "--yaw",
                 f"{draw.uniform(0, 360):.1f}", "--pitch", f"{draw.uniform(12, 40):.1f}", "-q"],
                check=True)
            truth = json.loads((scene / "truth.json").read_text())
            fit(args.bin / "pcl_sq_stereo", scene, scene / "left.png", scene / "right.png",
                scene / "calib.yml", truth["roi"], args.matcher)
    for folder in sorted(p.parent for p in args.pairs.glob("*/gt.yml")) if args.pairs else []:
        scene = args.out / folder.name
        scene.mkdir(parents=True, exist_ok=True)
        truth = truth_of_pair(folder)
        (scene / "truth.json").write_text(json.dumps(truth))
        fit(args.bin / "pcl_sq_stereo", scene, folder / "rect_left.png",
            folder / "rect_right.png", folder / "calib_rect.yml", truth["roi"], args.matcher)


if __name__ == "__main__":
    main()
