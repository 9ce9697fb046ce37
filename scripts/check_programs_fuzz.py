#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs whole programs on damaged files: check_programs_fuzz.py [RUNS] [SEED] [JOBS]

Each run changes one small valid file a little and demands: exit code 0, 1 or 2 within
10 s of processor time and 1 GiB, one clear sentence where it failed, results whole and
finite where it did not, nothing left of what failed. What breaks a demand is printed
with its command and kept in fuzz-findings/."""
import collections
import concurrent.futures
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading

from damaged_files import CONFIG, GRIPPER, calibrations, clouds, mutated

BIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "build", "bin")
KEPT = "fuzz-findings"
SECONDS, GIBIBYTE = 10, 1 << 20  # of processor time; in KiB
BATCH = 30                       # clouds for one process
# what only a program's inside would say
INTERNALS = re.compile(r"terminate called|what\(\)|std::|\[json|OpenCV\(|vtk|\[pcl::|_M_|"
                       r"basic_string|Assertion|exception|stoi|stod|[\x00-\x08\x0e-\x1f]")


def run(command, folder, seconds):
    """Exit code (negative: a signal), standard output and error, seconds, KiB."""
    with open(os.path.join(folder, "out"), "w+b") as out, \
            open(os.path.join(folder, "err"), "w+b") as err:
        child = subprocess.Popen(["prlimit", f"--cpu={seconds + 1}", *command],
                                 stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                 env={**os.environ, "OMP_NUM_THREADS": "1"})
        # a program that waits uses no processor time; a busy machine may take its time
        timer = threading.Timer(60 * seconds, child.kill)
        timer.start()
        _, status, usage = os.wait4(child.pid, 0)
        timer.cancel()
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0), err.seek(0)
        return (child.returncode, out.read(), err.read(), usage.ru_utime + usage.ru_stime,
                usage.ru_maxrss)


def not_finite(value):
    if isinstance(value, dict):
        return any(not_finite(v) for v in value.values())
    if isinstance(value, list):
        return any(not_finite(v) for v in value)
    return isinstance(value, float) and not math.isfinite(value)


def nonsense(text):
    """What is wrong with a result in JSON, or nothing."""
    try:
        result = json.loads(text)
    except ValueError as error:
        return f"no JSON: {error}"
    if not_finite(result):
        return "a number is not finite"
    parts = result.get("superquadrics")  # of an evaluation: their number
    for part in parts if isinstance(parts, list) else []:
        sizes = part.get("semi_axes")
        if not isinstance(sizes, list) or not all(
                isinstance(a, (int, float)) and 0 < a < 1e20 for a in sizes):
            return f"semi-axes {sizes}"
    for line in ("pose", "error"):
        if line in result and result[line] is None:
            return f"{line} is null"
    return None


def complaint(folder, outcome, outputs, allowed=1):
    """The demand that a run broke, or nothing."""
    code, _, err, seconds, memory = outcome
    text = err.decode(errors="replace")
    if code not in (0, 1, 2):
        return f"exit code {code}"
    if seconds > SECONDS * allowed:
        return f"{seconds:.1f} s"
    if memory > GIBIBYTE:
        return f"{memory >> 10} MiB"
    if found := INTERNALS.search(text):
        return f"message of an internal: {found.group()!r}"
    if any(len(line) > 600 for line in text.split("\n")) or text.count("\n") > 8 * allowed:
        return "a long message"
    if code and not text.strip():
        return "no message"
    for name in outputs:
        path = os.path.join(folder, name)
        if code == 0 and not os.path.exists(path):
            return f"{name} is missing"
        if code and os.path.exists(path):
            return f"{name} is there though it failed"
        if code == 0 and name.endswith(".json") and (wrong := nonsense(open(path).read())):
            return f"{name}: {wrong}"
        if code == 0 and os.path.getsize(path) == 0:
            return f"{name} is empty"
    for name in os.listdir(folder):
        if name.startswith(".") or "tmp" in name:
            return f"{name} is left"
    return None


class Kinds:
    """The kinds of runs: each writes a damaged file into a folder and returns a command
    and the names of the files that it is to leave."""

    def __init__(self, base):
        self.clouds, self.base = clouds(), base
        for name, data in self.clouds.items():
            open(os.path.join(base, name), "wb").write(data)
        scene = os.path.join(base, "can")
        self.call("render", "can", "--rig", "small", "--distortion", "--out", scene, "-q")
        self.rigs = calibrations(scene)
        self.scene = lambda name: os.path.join(scene, name)
        self.model = self.scene("model.json")
        self.call("stereo", self.scene("left.png"), self.scene("right.png"), "--calib",
                  self.scene("calib.yml"), "-o", self.model, "-q")
        self.all = [(self.fit_batch, 4), (self.fit, 4), (self.mask, 1), (self.config, 1),
                    (self.grasp, 5), (self.gripper, 3), (self.evaluate, 4), (self.truth, 2),
                    (self.truth_mesh, 3), (self.pose, 1), (self.snapshot, 4),
                    (self.snapshot_cloud, 2), (self.calibration, 8), (self.image, 1),
                    (self.depth, 1)]

    def call(self, program, *arguments):
        subprocess.run([os.path.join(BIN, "pcl_sq_" + program), *arguments], check=True)

    def damaged(self, folder, name, rng, data=None):
        path = os.path.join(folder, "in_" + os.path.basename(name))
        data = open(name, "rb").read() if data is None else data
        open(path, "wb").write(mutated(data, rng))
        return path

    def cloud(self, folder, rng):
        name = rng.choice(list(self.clouds))
        return self.damaged(folder, name, rng, self.clouds[name])

    def command(self, program, folder, arguments, **outputs):
        words = [os.path.join(BIN, "pcl_sq_" + program), *arguments]
        for option, name in outputs.items():
            dash = "-o" if option == "o" else "--" + option.replace("_", "-")
            words += [dash, os.path.join(folder, name)]
        return words, list(outputs.values())

    def fit(self, folder, rng):
        return self.command("fit", folder, [self.cloud(folder, rng), "--max-parts", "2"],
                            o="m.json", mesh=rng.choice(["m.ply", "m.obj", "m.stl"]))

    def fit_batch(self, folder, rng):
        names = []
        for i in range(BATCH):
            path = self.cloud(folder, rng)
            names.append(os.path.join(folder, f"{i}_{os.path.basename(path)}"))
            os.rename(path, names[-1])
        return self.command("fit", folder,
                            names + ["--max-parts", "2", "--jsonl", "--threads", "1"],
                            o="m.jsonl")

    def mask(self, folder, rng):
        mask = self.damaged(folder, self.scene("mask.png"), rng)
        return self.command("stereo", folder, [self.scene("left.png"), self.scene("right.png"),
                            "--calib", self.scene("calib.yml"), "--mask", mask], o="m.json")

    def config(self, folder, rng):
        file = self.damaged(folder, "fit.toml", rng, CONFIG)
        return self.command("fit", folder, [os.path.join(self.base, "ascii.pcd"), "--config",
                                            file], o="m.json")

    def grasp(self, folder, rng):
        return self.command("grasp", folder, [self.damaged(folder, self.model, rng), "--count",
                            "2", "--graspit-parts"], o="g.json", graspit="world")

    def gripper(self, folder, rng):
        hand = self.damaged(folder, "hand.toml", rng, GRIPPER)
        return self.command("grasp", folder, [self.model, "--count", "2", "--gripper", hand],
                            o="g.json")

    def evaluate(self, folder, rng):
        return self.command("evaluate", folder, [
            self.damaged(folder, self.model, rng), "--cloud",
            os.path.join(self.base, "binary.pcd")], o="e.json")

    def truth(self, folder, rng):
        text = open(self.scene("truth.json"), "rb").read()
        text = text.replace(b'"mesh.ply"', f'"{self.scene("mesh.ply")}"'.encode())
        truth = self.damaged(folder, "truth.json", rng, text)
        return self.command("evaluate", folder, [self.model, "--truth", truth, "--samples",
                                                 "1000"], o="e.json")

    def truth_mesh(self, folder, rng):
        name = rng.choice(["box.obj", "box.stl", "box.ply"])
        mesh = self.damaged(folder, name, rng, self.clouds[name])
        return self.command("evaluate", folder, [self.model, "--mesh", mesh, "--samples",
                                                 "1000"], o="e.json")

    def pose(self, folder, rng):
        pose = self.damaged(folder, "pose.txt", rng, b"1 0 0 0\n0 1 0 0\n0 0 1 .8\n0 0 0 1\n")
        return self.command("evaluate", folder, [
            self.model, "--mesh", os.path.join(self.base, "box.obj"), "--pose", pose,
            "--samples", "1000"], o="e.json")

    def snapshot(self, folder, rng):
        return self.command("snapshot", folder, [self.damaged(folder, self.model, rng),
                                                 "--size", "64x48"], o="s.png")

    def snapshot_cloud(self, folder, rng):
        return self.command("snapshot", folder, [
            self.model, "--cloud", self.cloud(folder, rng), "--size", "64x48"], o="s.png")

    def calibration(self, folder, rng):
        name = rng.choice(list(self.rigs))
        files = list(self.rigs[name])
        which, paths = rng.randrange(len(files)), []
        for i, data in enumerate(files):
            side = name if i == 0 else name.replace("left", "right")
            path = os.path.join(folder, side)
            open(path, "wb").write(mutated(data, rng) if i == which else data)
            paths.append(path)
        raw = "raw_" if name == "raw.yml" else ""
        return self.command("stereo", folder, [
            self.scene(raw + "left.png"), self.scene(raw + "right.png"), "--calib", *paths],
            o="m.json")

    def image(self, folder, rng):
        left = self.damaged(folder, self.scene("left.png"), rng)
        return self.command("stereo", folder, [left, self.scene("right.png"), "--calib",
                                               self.scene("calib.yml")], o="m.json")

    def depth(self, folder, rng):
        depth = self.damaged(folder, self.scene("disparity.pfm"), rng)
        return self.command("stereo", folder, [
            self.scene("left.png"), "--depth", depth, "--depth-scale", ".02", "--intrinsics",
            "405.8,405.8,159.5,119.5"], o="m.json")


def batch_complaint(folder, outcome, outputs):
    wrong = complaint(folder, outcome, [], BATCH)
    path = os.path.join(folder, outputs[0])
    if wrong or not os.path.exists(path):
        return wrong or "no lines"
    lines = open(path).read().splitlines()
    if len(lines) != BATCH:
        return f"{len(lines)} lines of {BATCH}"
    for i, line in enumerate(lines):
        if text := nonsense(line):
            return f"line {i}: {text}"
        if "superquadrics" not in json.loads(line) and not json.loads(line).get("error"):
            return f"line {i}: neither a model nor an error"
    return None


def main():
    runs, seed, jobs = ([int(a) for a in sys.argv[1:]] + [2000, 1, 2][len(sys.argv) - 1:])[:3]
    counts, findings = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as base:
        kinds = Kinds(base)
        makers, weights = zip(*kinds.all)

        def one(number):
            rng = random.Random(f"{seed} {number}")
            maker = rng.choices(makers, weights)[0]
            folder = os.path.join(base, str(number))
            os.mkdir(folder)
            command, outputs = maker(folder, rng)
            batch = maker == kinds.fit_batch
            outcome = run(command, folder, SECONDS * (BATCH if batch else 1))
            wrong = (batch_complaint if batch else complaint)(folder, outcome, outputs)
            if wrong:
                os.makedirs(KEPT, exist_ok=True)
                kept = os.path.join(KEPT, f"{seed}-{number}")
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(folder, kept)
                print(f"{seed}-{number} {maker.__name__}: {wrong}\n  " +
                      " ".join(command).replace(folder, kept)[:400] + "\n  " +
                      outcome[2].decode(errors="replace")[-400:], flush=True)
            shutil.rmtree(folder)
            return maker.__name__, outcome[0], BATCH if batch else 1, bool(wrong)

        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            try:
                for name, code, files, wrong in pool.map(one, range(runs)):
                    counts[name, code] += files
                    findings += wrong
            except KeyboardInterrupt:  # what is done counts
                pool.shutdown(cancel_futures=True)
    for (name, code), files in sorted(counts.items()):
        print(f"{name:16} exit code {code:3} {files:7} files")
    print(f"{sum(counts.values())} damaged files, {findings} findings")
    sys.exit(findings > 0)


if __name__ == "__main__":
    main()
