#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every command line of README.md, docs/ and each program's --help, copied literally:
    commands.py SOURCE_DIR PROGRAM_DIR
Files that a line names are made beforehand: from a small scene by their names, or by their
kinds. Lines that build (./scripts, cmake, cpack) are run by .ci/run in a fresh clone."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

import scene_files

source, programs = (os.path.abspath(p) for p in sys.argv[1:3])
BUILDING = re.compile(r"^\(?(\./scripts/|cmake |ctest |cpack |cd build|sudo |apt|git )")
HAS_BATCH = subprocess.run(
    [sys.executable, "-c", "import distributed, pcl_sq.batch"], capture_output=True,
    env=dict(os.environ, PYTHONPATH=os.path.join(os.path.dirname(programs), "python"))
).returncode == 0
# what a file of this name is, if the name says it; else the ending does
NAMED = {"depth.png": "depth.png", "mask.png": "mask.png", "labels.png": "mask.png",
         "left.png": "bottle/left.png", "right.png": "bottle/right.png",
         "im0.png": "bottle/left.png", "im1.png": "bottle/right.png",
         "left_01.png": "bottle/left.png", "right_01.png": "bottle/right.png",
         "left_02.png": "bottle/left.png", "right_02.png": "bottle/right.png",
         "calib.txt": "calib.txt", "scene.pcd": "kinect.pcd", "kinect.pcd": "kinect.pcd",
         "bottle.pcd": "kinect.pcd",
         "stereo_calib.xml": "stereo_calib.xml", "truth.json": "bottle/truth.json"}
ENDING = {".png": "color.png", ".pcd": "can.pcd", ".ply": "can.ply", ".obj": "mesh.obj",
          ".stl": "mesh.stl", ".xyz": "can.xyz", ".txt": "can.xyz", ".asc": "can.xyz",
          ".csv": "can.xyz", ".pts": "can.xyz", ".json": "model.json", ".toml": "hand.toml",
          ".yml": "bottle/calib.yml", ".yaml": "bottle/calib.yml"}
HAND = ('name = "hand"\nmax_opening = 0.14\nfinger_length = 0.06\nfinger_width = 0.02\n'
        "finger_thickness = 0.02\npad_length = 0.03\npalm_width = 0.15\n"
        "palm_depth = 0.07\npalm_height = 0.09\n")
POSE = ("%YAML:1.0\n---\nT_mesh_to_rectleft: !!opencv-matrix\n   rows: 4\n   cols: 4\n"
        "   dt: d\n   data: [ 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0.,\n"
        "       0., 0., 0., 1. ]\n")

ROS = """image_width: 1024
image_height: 768
camera_name: {side}
camera_matrix: {{rows: 3, cols: 3, data: [{f}, 0, {cx}, 0, {f}, {cy}, 0, 0, 1]}}
distortion_model: plumb_bob
distortion_coefficients: {{rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}}
rectification_matrix: {{rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}}
projection_matrix: {{rows: 3, cols: 4, data: [{f}, 0, {cx}, {move}, 0, {f}, {cy}, 0, 0, 0, 1, 0]}}
"""


def run(command, folder):
    environment = dict(os.environ, HOME=folder, GRASPIT=os.path.join(folder, "graspit"),
                       PATH=os.pathsep.join([programs, os.path.dirname(sys.executable),
                                             os.environ["PATH"]]),
                       PYTHONPATH=os.path.join(os.path.dirname(programs), "python"))
    return subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)


def prepare(folder):
    """The scene that files are copied from."""
    scene_files.depth_scene(folder)
    scene_files.chessboards(folder)
    for command in ("pcl_sq_render bottle --out bottle -q",
                    "pcl_sq_scene kinect.pcd -q -o tabletop.json",
                    "pcl_sq_fit can.pcd -q -o model.json --mesh mesh.stl",
                    "pcl_sq_fit can.pcd -q -o model.json --mesh mesh.obj"):
        done = run(command, folder)
        if done.returncode:
            sys.exit("%s\n%s" % (command, done.stdout))
    with open(folder + "/hand.toml", "w") as out:
        out.write(HAND)
    with open(folder + "/gt.yml", "w") as out:
        out.write(POSE)
    numbers = re.search(r"P2:.*?data: \[(.*?)\]", open(folder + "/bottle/calib.yml").read(),
                        re.S).group(1)
    f, _, cx, shift, _, _, cy = [float(n) for n in numbers.split(",")[:7]]
    for side, move in (("left", 0.0), ("right", shift)):  # as ROS writes them
        with open(folder + "/" + side + ".yaml", "w") as out:
            out.write(ROS.format(side=side, f=f, cx=cx, cy=cy, move=move))
    with open(folder + "/calib.txt", "w") as out:
        for camera in "01":
            out.write("cam%s=[%g 0 %g; 0 %g %g; 0 0 1]\n" % (camera, f, cx, f, cy))
        out.write("doffs=0\nbaseline=%g\nwidth=1024\nheight=768\nndisp=256\n"
                  % (-1000 * shift / f))


def provide(words, scene, folder):
    """Makes the files that a command line names and that are not there yet."""
    for word in re.split(r"[\s'\"=]+", words):
        word = word.split(":")[0]
        top = word.split("/")[0]
        if "/" in word and top and os.path.isdir(os.path.join(scene, top)) and \
                not os.path.exists(os.path.join(folder, top)):
            shutil.copytree(os.path.join(scene, top), os.path.join(folder, top))
        name = os.path.basename(word)
        stars = [name.replace("*", "%02d" % i) for i in (1, 2)] if "*" in name else [name]
        if name in ("left*.png", "right*.png"):
            stars = [n for n in sorted(os.listdir(scene)) if re.match(name[:-5] + r"\d", n)]
        for name in stars:
            path = os.path.join(folder, os.path.dirname(word), name)
            origin = name if os.path.isfile(os.path.join(scene, name)) else \
                NAMED.get(name, ENDING.get(os.path.splitext(name)[1]))
            if origin and not os.path.exists(path) and not word.startswith(("~", "/")):
                os.makedirs(os.path.dirname(path), exist_ok=True)
                shutil.copy(os.path.join(scene, origin), path)
                if name == "stereo_calib.xml":
                    provide("left*.png right*.png", scene, folder)


def joined(lines):
    return "\n".join(lines).replace("\\\n", " ").split("\n")


def documents():
    """(document, its command lines)"""
    paths = [source + "/README.md"]
    for folder, _, names in os.walk(source + "/docs"):
        paths += [os.path.join(folder, n) for n in sorted(names) if n.endswith(".md")]
    for path in paths:
        text = open(path).read()
        blocks = re.findall(r"^```(?:sh|bash|console)\n(.*?)^```", text, re.S | re.M)
        text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
        blocks += [" ".join(span.split())  # in the running text
                   for span in re.findall(r"`(pcl_sq_[a-z]+\s[^`]+)`", text)]
        lines = [l for block in blocks for l in joined(block.split("\n"))]
        lines = [re.sub(r"^\$ ", "", l.strip()) for l in lines]
        if not HAS_BATCH:  # what is not built or installed here is another machine's test
            lines = [l for l in lines if "pcl_sq.batch" not in l]
        yield os.path.relpath(path, source), [l for l in lines if l and l[0] != "#"
                                              and not BUILDING.match(l)]
    for program in sorted(os.listdir(programs)):
        if re.fullmatch(r"pcl_sq_[a-z]+", program) and \
                os.path.exists("%s/apps/%s.cpp" % (source, program)):
            text = run(program + " --help", programs).stdout
            examples = text.partition("Examples:\n")[2].partition("\n\n")[0]
            lines = [l.strip() for l in joined(examples.split("\n")) if l.startswith("  ")]
            if not lines:
                yield program + " --help", ["false # has no examples"]
            yield program + " --help", lines


failed = ran = 0
with tempfile.TemporaryDirectory() as temporary:
    scene = temporary + "/scene"
    os.mkdir(scene)
    prepare(scene)
    for number, (document, lines) in enumerate(documents()):
        folder = "%s/%d" % (temporary, number)
        os.mkdir(folder)
        for line in lines:
            provide(line, scene, folder)
            done = run(line, folder)
            ran += 1
            if done.returncode:
                failed += 1
                print("%s: %s\n  ended with %d: %s" % (document, line, done.returncode,
                                                       done.stdout.strip()[-600:]))
print("%d command lines, %d failed" % (ran, failed))
sys.exit(failed > 0 or ran < 20)
