#!/usr/bin/env python3
"""Draws the folders of the library and which may include which, from the ranks of check_arrows.py.

Usage: draw_architecture.py [--check]    Writes samples/pictures/architecture.svg, or checks that it is current.

A folder includes only folders in the rows below it, never one of its own row. A folder without a line in SAYS is an error.
"""
import pathlib
import sys
from xml.sax.saxutils import escape

from check_arrows import RANKS

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURE = ROOT / "samples" / "pictures" / "architecture.svg"

# What is in a folder, in at most three lines.
SAYS = {
    "core": ["vectors, boxes, rays, triangles; errors, threads, hashes"],
    "tree": ["the canonical tree,", "validation, refit,", "SAH cost, clusters"],
    "container": ["chunks, checksums,", "codecs; knows", "nothing of trees"],
    "scene": ["triangles, geometries, instances"],
    "importers": ["glTF, OBJ, PLY,", "STL, Draco"],
    "build": ["builders: triangles", "to a tree"],
    "restructure": ["optimizers: tree to", "a better tree"],
    "relayout": ["layouts: order of", "nodes in memory"],
    "compress": ["forms: encoders", "and decoders"],
    "rays": ["ray sets, cameras,", "ray and hit files"],
    "metrics": ["what tracing counts;", "the cache model"],
    "pictures": ["PNG, heat maps,", "shaded images"],
    "trace": ["the traversal loop", "and its steps,", "per processor"],
    "stats": ["numbers about", "trees and files"],
    "file": ["which chunks hold", "scene and tree"],
    "api": ["the installed", "headers: C API", "and C++ wrapper"],
    "reader": ["stand-ins for oneTBB", "and Draco"],
    "tools": ["six command-line programs"],
}
TITLES = {"tools": "tools/"}
COLOURS = ["#dbe9f6", "#e3f0d8", "#fdf0cf", "#fbe0cd", "#f3d9e5", "#e4dcf1", "#d8ecec", "#e8e8e8"]

WIDTH, BOX, GAP, ROW, STEP = 920, 138, 10, 78, 108


def box(x, y, width, name, colour):
    middle, says = x + width / 2, SAYS[name]
    top = y + (ROW - 16 * len(says)) / 2
    lines = [f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{ROW}" rx="6" fill="{colour}" stroke="#777"/>',
             f'<text x="{middle:g}" y="{top + 4:g}" font-size="15" font-weight="bold">{escape(TITLES.get(name, name))}</text>']
    for i, line in enumerate(says):
        lines.append(f'<text x="{middle:g}" y="{top + 22 + 16 * i:g}" font-size="12">{escape(line)}</text>')
    return lines


def arrow(y):
    """From a row down to the next."""
    x = WIDTH / 2
    return [f'<path d="M{x:g} {y:g} v{STEP - ROW - 9}" stroke="#555" stroke-width="2"/>',
            f'<path d="M{x - 6:g} {y + STEP - ROW - 11:g} h12 l-6 9 z" fill="#555"/>']


def draw():
    rows = [*RANKS, ["tools"]]
    height = STEP * len(rows) + 14
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" '
             'font-family="Helvetica, Arial, sans-serif" text-anchor="middle" fill="#222">',
             "<title>Folders of the library: each includes only folders in the rows below it</title>",
             f'<rect width="{WIDTH}" height="{height}" fill="white"/>']
    for rank, folders in enumerate(rows):
        y = STEP * (len(rows) - 1 - rank) + 10
        width = BOX if len(folders) > 1 else 3 * BOX + 2 * GAP
        x = (WIDTH - len(folders) * width - (len(folders) - 1) * GAP) / 2
        for i, name in enumerate(folders):
            if name not in SAYS:
                sys.exit(f"draw_architecture.py: say in SAYS what is in the folder {name}")
            lines += box(x + i * (width + GAP), y, width, name, COLOURS[rank % len(COLOURS)])
        lines += arrow(y + ROW) if rank > 0 else []
    return "\n".join([*lines, "</svg>", ""])


def main():
    if "--check" not in sys.argv[1:]:
        PICTURE.write_text(draw())
        return 0
    if PICTURE.exists() and PICTURE.read_text() == draw():
        return 0
    print(f"{PICTURE.relative_to(ROOT)} is not current: run tests/draw_architecture.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
