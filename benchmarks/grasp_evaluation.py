#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Shares of top-ranked grasps that are antipodal and free of collision on the true shape.

usage: grasp_evaluation.py PROGRAM SCENES [--models true perturbed box] [--fitted NAME]
                           [--gripper wsg_50] [--limit N]

PROGRAM is pcl_sq_benchmark_grasp_evaluation. SCENES holds one folder per scene with
truth.json (parts or a mesh, table) and the object's points in object.xyz or object.pcd.
--fitted NAME also plans on SCENES/<i>/NAME, a model file written by pcl_sq_fit or
pcl_sq_stereo.
"""
import argparse
import json
import pathlib
import subprocess


def evaluate(program, scene, model, gripper, seed):
    command = [program, scene / "truth.json", "--model", str(model), "--gripper", gripper,
               "--points", next(scene.glob("object.*")), "--seed", str(seed)]
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        return {"grasps": 0, "failure": done.stderr.strip(), "antipodal": [], "free": []}
    return json.loads(done.stdout)


def share(results, key, top):
    values = [v for r in results for v in r[key][:top]]
    return sum(values) / len(values) if values else float("nan")


def both(results, top):
    values = [a and f for r in results for a, f in zip(r["antipodal"][:top], r["free"][:top])]
    return sum(values) / len(values) if values else float("nan")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scenes", type=pathlib.Path)
    parser.add_argument("--models", nargs="*", default=["true", "perturbed", "box"])
    parser.add_argument("--fitted")
    parser.add_argument("--gripper", default="wsg_50")
    parser.add_argument("--limit", type=int, default=10 ** 6)
    parser.add_argument("-v", "--verbose", action="store_true")
    args = parser.parse_args()
    scenes = sorted((p.parent for p in args.scenes.glob("*/truth.json")),
                    key=lambda p: (len(p.name), p.name))[:args.limit]
    print(f"{len(scenes)} scenes, {args.gripper}, friction 0.5")
    print("model        planned | top 1: antipodal  free   both | top 10: antipodal  free   both")
    for model in args.models + ([args.fitted] if args.fitted else []):
        results = []
        for seed, scene in enumerate(scenes):
            path = scene / model if model == args.fitted else model
            if model == args.fitted and not path.exists():
                results.append({"grasps": 0, "antipodal": [], "free": []})
                continue
            results.append(evaluate(args.program, scene, path, args.gripper, seed))
            if args.verbose and results[-1]["grasps"]:
                r = results[-1]
                if not all(r["antipodal"]) or not all(r["free"]):
                    print("  ", scene.name, r["antipodal"], r["free"])
            elif args.verbose:
                print("  ", scene.name, results[-1].get("failure"))
        planned = sum(r["grasps"] > 0 for r in results)
        print(f"{model:12s} {planned:4d}/{len(scenes):<4d}|"
              f" {share(results, 'antipodal', 1):16.3f} {share(results, 'free', 1):6.3f}"
              f" {both(results, 1):6.3f} |"
              f" {share(results, 'antipodal', 10):17.3f} {share(results, 'free', 10):6.3f}"
              f" {both(results, 10):6.3f}")


if __name__ == "__main__":
    main()
