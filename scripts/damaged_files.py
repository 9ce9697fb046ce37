# SPDX-License-Identifier: BSD-3-Clause
"""Small valid files of every kind that the programs read, and what damages them."""
import math
import os
import random
import re
import struct

WORDS = [b"1e300", b"-1e-300", b"nan", b".inf", b"1e999", b"-0", b"[", b"]", b"{", b"}",
         b"\n", b": ", b",", b'"', b"<", b">", b"&a", b"*a", b"null", b"\xff", b"\x01",
         b"0", b"99999999999999999999", b"-1", b"2147483648"]


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
