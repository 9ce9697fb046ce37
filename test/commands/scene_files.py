# SPDX-License-Identifier: BSD-3-Clause
"""Small inputs for the documentation's command lines: a can on a table seen by a depth
camera, and chessboards seen by two cameras. Plain Python, nothing to install."""
import math
import struct
import zlib

WIDTH, HEIGHT = 640, 480
FX, FY, CX, CY = 616.0, 616.0, 310.0, 237.0  # of pcl_sq_stereo's example
RADIUS, TALL, AHEAD, PITCH, LIFT = .033, .12, .55, math.radians(25), .40


def png(path, width, height, channels, bits, rows):
    """rows: one bytes object each."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    header = struct.pack(">IIBBBBB", width, height, bits, {1: 0, 3: 2}[channels], 0, 0, 0)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                  + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + r for r in rows), 1))
                  + chunk(b"IEND", b""))


def look(u, v):
    """(depth along the camera's axis, whether it is the can) at a pixel; the camera stands
    LIFT above the table's origin and looks PITCH down."""
    x, y = (u - CX) / FX, (v - CY) / FY
    down, ahead = y * math.cos(PITCH) + math.sin(PITCH), math.cos(PITCH) - y * math.sin(PITCH)
    best, can = math.inf, False
    if down > 1e-6:
        best = LIFT / down
        top = (LIFT - TALL) / down  # the can's lid
        if math.hypot(top * x, top * ahead - AHEAD) <= RADIUS:
            best, can = top, True
    # the can's side: |(t x, t ahead - AHEAD)| = RADIUS
    a, b, c = x * x + ahead * ahead, -ahead * AHEAD, AHEAD * AHEAD - RADIUS * RADIUS
    if b * b > a * c:
        t = (-b - math.sqrt(b * b - a * c)) / a
        if 0 < LIFT - t * down < TALL and t < best:
            best, can = t, True
    return (best, can) if best < 2 else (math.nan, False)


def depth_scene(folder):
    """kinect.pcd (organized), can.pcd and can.ply (the can alone), depth, colour, mask."""
    rows = [[look(u, v) for u in range(WIDTH)] for v in range(HEIGHT)]
    points = [((u - CX) / FX * z, (v - CY) / FY * z, z)
              for v, row in enumerate(rows) for u, (z, _) in enumerate(row)]
    flags = [can for row in rows for _, can in row]
    pcd(folder + "/kinect.pcd", points, WIDTH, HEIGHT)
    alone = [p for p, can in zip(points, flags) if can][::3]
    pcd(folder + "/can.pcd", alone, len(alone), 1)
    with open(folder + "/can.ply", "w") as out:
        out.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(alone)
                  + "".join("property float %s\n" % c for c in "xyz") + "end_header\n")
        out.writelines("%.6f %.6f %.6f\n" % p for p in alone)
    with open(folder + "/can.xyz", "w") as out:
        out.writelines("%.6f %.6f %.6f\n" % p for p in alone)
    png(folder + "/depth.png", WIDTH, HEIGHT, 1, 16,
        [struct.pack(">%dH" % WIDTH, *(0 if z != z else round(1000 * z) for z, _ in row))
         for row in rows])
    png(folder + "/mask.png", WIDTH, HEIGHT, 1, 8,
        [bytes(255 if can else 0 for _, can in row) for row in rows])
    png(folder + "/color.png", WIDTH, HEIGHT, 3, 8,
        [b"".join(b"\xb4\x28\x28" if can else b"\x78\x82\x78" for _, can in row)
         for row in rows])


def pcd(path, points, width, height):
    with open(path, "wb") as out:
        out.write(("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                   "WIDTH %d\nHEIGHT %d\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA binary\n"
                   % (width, height, len(points))).encode())
        out.write(b"".join(struct.pack("<3f", *p) for p in points))


def chessboards(folder, square=.025, columns=9, rows=6, baseline=.12, pairs=6):
    """leftNN.png, rightNN.png and stereo_calib.xml: boards of columns x rows inner corners."""
    names = []
    width, height, f = 320, 240, 300.0
    for pair in range(pairs):
        a, b = .5 * math.sin(1.3 * pair), .45 * math.cos(2.1 * pair)
        # columns of the board's rotation: about y by a, then about x by b
        ex = (math.cos(a), math.sin(a) * math.sin(b), -math.sin(a) * math.cos(b))
        ey = (0.0, math.cos(b), math.sin(b))
        n = (ex[1] * ey[2] - ex[2] * ey[1], ex[2] * ey[0] - ex[0] * ey[2],
             ex[0] * ey[1] - ex[1] * ey[0])
        centre = (.06 + .03 * math.sin(pair), .02 * math.cos(3 * pair), .42 + .02 * (pair % 3))
        for side, shift in (("left", 0.0), ("right", baseline)):
            from_camera = (centre[0] - shift, centre[1], centre[2])
            distance = sum(p * q for p, q in zip(n, from_camera))

            def shade(u, v):
                ray = ((u - width / 2) / f, (v - height / 2) / f, 1.0)
                t = distance / sum(p * q for p, q in zip(n, ray))
                off = [t * r - c for r, c in zip(ray, from_camera)]
                i = math.floor(sum(p * q for p, q in zip(ex, off)) / square + (columns + 1) / 2)
                j = math.floor(sum(p * q for p, q in zip(ey, off)) / square + (rows + 1) / 2)
                inside = 0 <= i <= columns and 0 <= j <= rows
                return 20 if inside and (i + j) % 2 else 230

            names.append("%s%02d.png" % (side, pair + 1))
            png(folder + "/" + names[-1], width, height, 1, 8,
                [bytes(shade(u, v) for u in range(width)) for v in range(height)])
    with open(folder + "/stereo_calib.xml", "w") as out:
        out.write('<?xml version="1.0"?>\n<opencv_storage>\n<imagelist>\n%s\n</imagelist>\n'
                  "</opencv_storage>\n" % "\n".join('"%s"' % name for name in names))
