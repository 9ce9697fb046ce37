#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Accuracy and time of the full fit on generated superquadrics with exact truth.

usage: compare.py GENERATORS --program pcl_sq_fit_xyz [--out DIR] [--seeds 0 1 2] [--n 50]

GENERATORS is the folder with gen.py, score.py and reference.md (the peers' figures). The
data are generated once into OUT. Prints the table of reference.md with our column beside
the peers', for each seed, and draws accuracy against time (needs matplotlib).
"""
import argparse
import importlib.util
import json
import os
import re
import statistics
import subprocess
import sys

SETS = ["clean", "metric", "noise1", "noise2", "noise3", "knn60", "view", "view_n1",
        "view_metric", "view_stereo", "out20", "out40", "out60", "out80", "out40_n1"]


def generate(generators, out, seed, count):
    """Data of one seed; made only where they are missing."""
    folder = os.path.join(out, f"data{seed}")
    if not os.path.exists(os.path.join(folder, "clean", f"{count - 1}.xyz")):
        subprocess.run([sys.executable, os.path.join(generators, "gen.py"), folder,
                        str(count)], check=True, stdout=subprocess.DEVNULL,
                       env=dict(os.environ, SEED=str(seed)))
    return folder


def run(program, folder, name, count, score):
    """Scores and times of one set."""
    files = [os.path.join(folder, name, f"{i}.xyz") for i in range(count)]
    lines = subprocess.run([program] + files, check=True, capture_output=True,
                           text=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
    rows = []
    for file, line in zip(files, lines.stdout.splitlines()):
        fit = json.loads(line)
        with open(file[:-4] + ".json", encoding="ascii") as truth:
            rows.append((score.score(json.load(truth), fit, key=file)["iou"],
                         1e3 * fit.get("cpu", float("nan"))))
    iou = [r[0] for r in rows]
    return {"iou": statistics.mean(iou),
            "fail": sum(i < 0.8 for i in iou) / len(iou),
            "ms": statistics.median(r[1] for r in rows)}


def reference(generators):
    """The SEED=0 table of reference.md: {set: [cells of EMS and of the oracle]}."""
    peers = {}
    with open(os.path.join(generators, "reference.md"), encoding="utf-8") as file:
        text = file.read().split("## Same generator")[0]
    for line in text.splitlines():
        cells = [c.strip() for c in line.strip().strip("|").split("|")]
        if len(cells) == 3 and cells[0] in SETS:
            peers[cells[0]] = cells[1:]
    return peers


def figure(path, ours, peers):
    """Mean IoU against time, ours and EMS, one line a set."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    pyplot.figure(figsize=(9, 6))
    points = []
    for name, result in ours.items():
        match = re.match(r"([.\d]+) / .* / ([.\d]+) ms", peers.get(name, [""])[0])
        if match:
            points.append((float(match.group(2)), float(match.group(1)), name, result))
    labelled = []
    for ms, iou, name, result in sorted(points, key=lambda p: p[:3]):
        first = not labelled
        pyplot.plot([result["ms"], ms], [result["iou"], iou], color="0.85", zorder=1)
        pyplot.scatter(ms, iou, color="tab:orange", zorder=2,
                       label="EMS (Liu et al. 2022)" if first else None)
        pyplot.scatter(result["ms"], result["iou"], color="tab:blue", zorder=2,
                       label="pcl_sq, full fit" if first else None)
        # a label goes up until it stands clear of the others
        height = iou
        while any(ms < 1.6 * m and m < 1.6 * ms and abs(height - h) < 0.009
                  for m, h in labelled):
            height += 0.0092
        labelled.append((ms, height))
        pyplot.text(1.07 * ms, height, name, fontsize=8, verticalalignment="center")
    pyplot.xscale("log")
    pyplot.xlim(0.4, 1000)
    pyplot.ylim(None, 1.04)
    pyplot.xlabel("time of a fit, one thread [ms]")
    pyplot.ylabel("mean volumetric IoU")
    pyplot.grid(alpha=0.3)
    pyplot.legend(loc="lower left")
    pyplot.tight_layout()
    pyplot.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("generators")
    parser.add_argument("--program", required=True)
    parser.add_argument("--out", default="compare_data")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0])
    parser.add_argument("--n", type=int, default=50)
    parser.add_argument("--sets", nargs="+", default=SETS)
    parser.add_argument("--figure")
    arguments = parser.parse_args()
    if arguments.figure and importlib.util.find_spec("matplotlib") is None:
        parser.error("--figure needs matplotlib (Debian: python3-matplotlib)")
    sys.path.insert(0, arguments.generators)
    import score
    peers = reference(arguments.generators)
    folders = [generate(arguments.generators, arguments.out, seed, arguments.n)
               for seed in arguments.seeds]
    print("Mean IoU / failures (IoU < .8) / median time; peers at SEED=0.\n")
    print("| set | EMS | oracle (radial) | "
          + " | ".join(f"pcl_sq, SEED={s}" for s in arguments.seeds) + " |")
    print("|---" * (3 + len(arguments.seeds)) + "|", flush=True)
    first = {}
    for name in arguments.sets:
        cells = peers.get(name, ["", ""])
        for folder in folders:
            r = run(arguments.program, folder, name, arguments.n, score)
            first.setdefault(name, r)
            cells = cells + [f"{r['iou']:.4f} / {100 * r['fail']:.0f} % / {r['ms']:.2f} ms"]
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)
    if arguments.figure:
        figure(arguments.figure, first, peers)


if __name__ == "__main__":
    main()
