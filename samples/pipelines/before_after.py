#!/usr/bin/env python3
"""Draws what a better tree saves: heat maps of one scene over two trees, side by side and on one scale.

Usage: before_after.py [SCENE] -o PICTURE.png [--resolution WxH] [--scale N]

On the left is the tree of the median builder, on the right that of bvh-build's defaults after bvh-restructure. Also prints a table in
Markdown: the costs of both trees, and of bvh-build's default tree, for primary and diffuse rays. The tools must be on PATH.
"""
import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "..", "scenes", "courtyard.glb")
GAP = 8  # pixels between the pictures
PAPER = bytes([24, 24, 28])  # the legend's background


def run(*command):
    result = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE)
    if result.returncode != 0:
        sys.exit(f"before_after.py: failed: {' '.join(map(str, command))}")
    return result.stdout


def read_png(path):
    """Returns the rows of a picture as bytes of RGB: what bvh-trace writes, 8 bits per channel and not interlaced."""
    with open(path, "rb") as file:
        data = file.read()
    width, height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", data[16:29])
    if (depth, color, interlaced) != (8, 2, 0):
        sys.exit(f"before_after.py: {path}: not a PNG of 8-bit RGB without interlacing")
    packed, at = b"", 8
    while at < len(data):
        (size,), kind = struct.unpack(">I", data[at:at + 4]), data[at + 4:at + 8]
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    raw, stride = zlib.decompress(packed), 3 * width
    rows, above = [], bytearray(stride)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
            up = above[i]
            # The five filters of PNG: each byte is stored as its difference from a prediction.
            nearest = min((left, up, corner), key=lambda value: abs(left + up - corner - value))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, nearest)[kind]) & 255
        rows.append(bytes(row))
        above = row
    return rows


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    width, packed, above = len(rows[0]) // 3, b"", bytes(len(rows[0]))
    for row in rows:  # filter 2: differences from the row above
        packed += b"\2" + bytes((a - b) & 255 for a, b in zip(row, above))
        above = row
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(packed, 9)) + chunk(b"IEND", b""))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?", default=SCENE, metavar="SCENE")
    parser.add_argument("-o", "--output", required=True, metavar="PICTURE.png")
    parser.add_argument("--resolution", default="600x400", metavar="WxH")
    parser.add_argument("--scale", type=int, default=400, metavar="N", help="tests per ray drawn as white (default 400)")
    options = parser.parse_args()
    width, height = map(int, options.resolution.split("x"))

    with tempfile.TemporaryDirectory() as work:
        before, built, after = (os.path.join(work, name) for name in ("before.bvhx", "built.bvhx", "after.bvhx"))
        run("bvh-build", options.scene, "--builder", "median", "-o", before)
        run("bvh-build", options.scene, "-o", built)
        run("bvh-restructure", built, "-o", after)

        def trace(tree, *more):
            return json.loads(run("bvh-trace", tree, "--repeat", 1, "--format", "json", *more))

        def heat_map(tree, size):
            picture = os.path.join(work, "picture.png")
            trace(tree, "--resolution", size, "--heatmap", picture, "--heatmap-scale", options.scale)
            return read_png(picture)

        left, right = heat_map(before, options.resolution), heat_map(after, options.resolution)
        # A picture that is one pixel high has the legend in the width of both.
        legend = heat_map(after, f"{2 * width + GAP}x1")[1:]
        write_png(options.output, [a + GAP * PAPER + b for a, b in zip(left[:height], right[:height])] + legend)

        trees = (before, built, after)
        costs = [json.loads(run("bvh-stats", tree, "--no-epo", "--format", "json"))["sah_cost"] for tree in trees]
        rows = [("SAH cost", costs)]
        for rays in ("primary", "diffuse"):
            reports = [trace(tree, "--rays", rays, "--resolution", options.resolution) for tree in trees]
            rows.append((f"boxes tested per {rays} ray", [report["NC"] for report in reports]))
            rows.append((f"triangles tested per {rays} ray", [report["TC"] for report in reports]))
    print("| | median split | binned SAH | binned SAH + reinsertion |\n|---|---|---|---|")
    for name, values in rows:
        print(f"| {name} | " + " | ".join(f"{value:.1f}" for value in values) + " |")


if __name__ == "__main__":
    main()
