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
import struct
import subprocess
import sys
import tempfile
import threading

BIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "build", "bin")
KEPT = "fuzz-findings"
SECONDS, GIBIBYTE = 10, 1 << 20  # of processor time; in KiB
BATCH = 30                       # clouds for one process
WORDS = [b"1e300", b"-1e-300", b"nan", b".inf", b"1e999", b"-0", b"[", b"]", b"{", b"}",
         b"\n", b": ", b",", b'"', b"<", b">", b"&a", b"*a", b"null", b"\xff", b"\x01",
         b"0", b"99999999999999999999", b"-1", b"2147483648"]
# what only a program's inside would say
INTERNALS = re.compile(r"terminate called|what\(\)|std::|\[json|OpenCV\(|vtk|\[pcl::|_M_|"
                       r"basic_string|Assertion|exception|stoi|stod|[\x00-\x08\x0e-\x1f]")


def mutated(data, rng):
    """The same kinds of damage as in test/support/mutate.h."""
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        if not data:
            break
        # headers are short and matter most
        at = rng.randrange(len(data) if rng.random() < .7 else min(len(data), 400))
        length, kind = rng.randint(1, 8), rng.randrange(6)
        if kind == 0:
            data[at] = rng.randrange(256)
        elif kind == 1:
            del data[at:at + length]
        elif kind == 2:
            begin = rng.randrange(len(data))
            data[at:at] = data[begin:begin + 4 * length]
        elif kind == 3:
            data[at:at] = rng.choice(WORDS)
        elif kind == 4:
            number = re.compile(rb"[0-9][0-9.eE+-]*").search(data, at)
            if number:
                data[number.start():number.end()] = rng.choice(WORDS)
        elif rng.random() < .3:
            del data[at:]
    return bytes(data)


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


# ------------------------------------------------------------------ the valid files

def can_points(count=300):
    rng = random.Random(1)
    points = []
    for _ in range(count):
        a, h = rng.uniform(0, 2 * math.pi), rng.uniform(-.05, .05)
        r = .03 if rng.random() < .8 else .03 * math.sqrt(rng.random())
        z = h if r == .03 else math.copysign(.05, h)
        points.append((r * math.cos(a), r * math.sin(a), .7 + z))
    return points


def pcd(fields, sizes, types, width, height, data, body):
    return (f"# .PCD v0.7\nVERSION 0.7\nFIELDS {fields}\nSIZE {sizes}\nTYPE {types}\nCOUNT "
            f"{' '.join('1' for _ in fields.split())}\nWIDTH {width}\nHEIGHT {height}\n"
            f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {width * height}\nDATA {data}\n").encode() + body


def lzf_literals(data):
    """LZF without any back reference."""
    return b"".join(bytes([len(data[i:i + 32]) - 1]) + data[i:i + 32]
                    for i in range(0, len(data), 32))


def clouds():
    points = can_points()
    n, rows = len(points), "".join("%.5f %.5f %.5f\n" % p for p in points).encode()
    floats = b"".join(struct.pack("<3f", *p) for p in points)
    columns = b"".join(struct.pack(f"<{n}f", *(p[k] for p in points)) for k in range(3))
    packed = lzf_literals(columns)
    image, w, h, f = b"", 40, 30, 40.0  # a ball before a wall, seen by a camera
    for v in range(h):
        for u in range(w):
            ray = ((u - 19.5) / f, (v - 14.5) / f, 1.0)
            rr, rc = sum(x * x for x in ray), .7
            root = rc * rc - rr * (.49 - .0144)
            t = (rc - math.sqrt(root)) / rr if root > 0 else 1.0
            image += struct.pack("<3f", *(t * x for x in ray))
    ply = (f"ply\nformat %s 1.0\nelement vertex {n}\nproperty float x\nproperty float y\n"
           "property float z\nend_header\n")
    vertices = b"".join(b"v %f %f %f\n" % p for p in
                        [(x, y, z) for x in (0, .1) for y in (0, .2) for z in (0, .3)])
    corners = [(1, 2, 4), (1, 4, 3), (5, 7, 8), (5, 8, 6), (1, 5, 6), (1, 6, 2), (3, 4, 8),
               (3, 8, 7), (1, 3, 7), (1, 7, 5), (2, 6, 8), (2, 8, 4)]
    faces = b"".join(b"f %d %d %d\n" % c for c in corners)
    box = [(x, y, z) for x in (0, .1) for y in (0, .2) for z in (0, .3)]
    stl = bytes(80) + struct.pack("<I", 12) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for i in c for x in box[i - 1]), 0) for c in corners)
    mesh_ply = (b"ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
                b"property float z\nelement face 12\nproperty list uchar int vertex_indices\n"
                b"end_header\n" + vertices.replace(b"v ", b"") +
                b"".join(b"3 %d %d %d\n" % tuple(i - 1 for i in c) for c in corners))
    return {
        "ascii.pcd": pcd("x y z", "4 4 4", "F F F", n, 1, "ascii", rows),
        "binary.pcd": pcd("x y z", "4 4 4", "F F F", n, 1, "binary", floats),
        "packed.pcd": pcd("x y z", "4 4 4", "F F F", n, 1, "binary_compressed",
                          struct.pack("<2I", len(packed), len(columns)) + packed),
        "image.pcd": pcd("x y z", "4 4 4", "F F F", w, h, "binary", image),
        "ascii.ply": (ply % "ascii").encode() + rows,
        "binary.ply": (ply % "binary_little_endian").encode() + floats,
        "rows.xyz": rows, "rows.csv": b"x,y,z\n" + rows.replace(b" ", b","),
        "box.obj": vertices + faces, "box.stl": stl, "box.ply": mesh_ply}


def calibrations(scene):
    """Files of one rig in the formats of their makers, by name."""
    fx, cx, cy, b = 405.8, 159.5, 119.5, .12
    read = lambda name: open(os.path.join(scene, name), "rb").read()

    def ros(tx):
        return (f"image_width: 320\nimage_height: 240\ncamera_name: left\ncamera_matrix:\n"
                f"  rows: 3\n  cols: 3\n  data: [{fx}, 0, {cx}, 0, {fx}, {cy}, 0, 0, 1]\n"
                f"distortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n"
                f"  data: [0, 0, 0, 0, 0]\nrectification_matrix:\n  rows: 3\n  cols: 3\n"
                f"  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nprojection_matrix:\n  rows: 3\n  cols: 4\n"
                f"  data: [{fx}, 0, {cx}, {tx}, 0, {fx}, {cy}, 0, 0, 0, 1, 0]\n").encode()

    def kalibr(name, extra):
        return (f"{name}:\n  camera_model: pinhole\n  distortion_coeffs: [0, 0, 0, 0]\n"
                f"  distortion_model: radtan\n  intrinsics: [{fx}, {fx}, {cx}, {cy}]\n"
                f"  resolution: [320, 240]\n{extra}")

    def zed(side):
        return (f"[{side}_CAM_VGA]\nfx={fx}\nfy={fx}\ncx={cx}\ncy={cy}\nk1=0\nk2=0\np1=0\n"
                f"p2=0\nk3=0\n")
    return {
        "opencv.yml": [read("calib.yml")], "raw.yml": [read("calib_raw.yml")],
        "left.yaml": [ros(0), ros(-fx * b)],
        "camchain.yaml": [(kalibr("cam0", "") + kalibr(
            "cam1", f"  T_cn_cnm1:\n  - [1, 0, 0, {-b}]\n  - [0, 1, 0, 0]\n"
                    "  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n")).encode()],
        "SN1.conf": [(zed("LEFT") + zed("RIGHT") + f"[STEREO]\nBaseline={1e3 * b}\nTY=0\nTZ=0\n"
                      "CV_VGA=0\nRX_VGA=0\nRZ_VGA=0\n").encode()],
        "calib.txt": [f"cam0=[{fx} 0 {cx}; 0 {fx} {cy}; 0 0 1]\ncam1=[{fx} 0 {cx}; 0 {fx} {cy};"
                      f" 0 0 1]\ndoffs=0\nbaseline={1e3 * b}\nwidth=320\nheight=240\n".encode()]}


GRIPPER = b'name = "wide"\nmax_opening = 0.2\nfinger_length = 0.12\npad_length = 0.03\n' \
          b'palm_width = 0.3\n'
CONFIG = b'max-parts = 2\nthreads = 1\ntable = "0,0,1,-0.65"\nunit = "m"\n'


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
