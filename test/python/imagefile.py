# SPDX-License-Identifier: BSD-3-Clause
"""PNG files without a library: 8 bits, RGB or grey, not interlaced."""
import struct
import zlib

import numpy as np


def read_png(path):
    data = open(path, "rb").read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, color, _, _, interlace = struct.unpack(">IIBBBBB", body)
            assert bits == 8 and color in (0, 2, 6) and not interlace
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    channels = {0: 1, 2: 3, 6: 4}[color]
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, -1)
    image = np.zeros((height, width * channels), np.int64)
    before = np.zeros(width * channels, np.int64)
    for y in range(height):
        kind, row = rows[y, 0], rows[y, 1:].astype(np.int64)
        if kind == 2:
            row = (row + before) & 255
        elif kind == 1:
            row = np.cumsum(row.reshape(width, channels), axis=0).ravel() & 255
        elif kind in (3, 4):
            row = row.reshape(width, channels)
            up = before.reshape(width, channels)
            left, corner = np.zeros(channels, np.int64), np.zeros(channels, np.int64)
            for x in range(width):
                if kind == 3:
                    guess = (left + up[x]) // 2
                else:
                    p = left + up[x] - corner
                    a, b, c = abs(p - left), abs(p - up[x]), abs(p - corner)
                    guess = np.where((a <= b) & (a <= c), left, np.where(b <= c, up[x], corner))
                left, corner = (row[x] + guess) & 255, up[x]
                row[x] = left
            row = row.ravel()
        image[y] = before = row
    image = image.astype(np.uint8).reshape(height, width, channels)
    return image[:, :, 0] if channels == 1 else image[:, :, :3]


def write_png16(path, image):
    """A grey image of 16 bits."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(
            ">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in image)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(
            ">IIBBBBB", image.shape[1], image.shape[0], 16, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
