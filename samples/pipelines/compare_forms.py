#!/usr/bin/env python3
"""Compares all forms with each other, and two of them with the figures of their papers.

Usage: compare_forms.py [--rays N] [--repeat N] [--table FILE.md] [--plot FILE.png] NAME=SCENE...

For each scene two trees are built, one with a single triangle per leaf and one with bvh-build's default leaves. bvh-compress
--pareto measures every form and its parameters on both. The slowdown is the time divided by that of the aabb form of the same
tree, on one thread, in runs that alternate with it: medians of --repeat runs over primary and diffuse rays. Scenes called Bunny,
Dragon, Buddha, Sponza or Bones are compared with their rows in the papers. The tools must be on PATH; --plot needs matplotlib
(Debian: python3-matplotlib). --table keeps a page up to its line <!-- compare_forms.py writes what follows -->.
"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

from page import require_matplotlib, write_after_marker

MARKER = "<!-- compare_forms.py writes what follows -->"
TREES = [  # key, heading, options of bvh-build
    ("single", "One triangle per leaf", ["--max-leaf-size", 1]),
    ("own", "bvh-build's default leaves, of up to four triangles", []),
]

# M. Eisemann, C. Woizischke, M. Magnor, "Ray Tracing with the Single-Slab Hierarchy", VMV 2008, table 1, as quoted in A. Trifonov's
# slides on BVHs (2022): primary rays, 640 x 480, on one core of 2008 with packets of 2 x 2. For BVH and SSH: nodes traversed
# and triangles tested per ray, seconds to trace, MiB.
SSH_PAPER = {
    "bunny": (69451, (8.77, 18.01), (0.55, 1.31), (0.66, 0.65), (4.24, 1.06)),
    "dragon": (871414, (10.47, 23.21), (0.95, 2.11), (0.84, 0.89), (53.19, 13.30)),
    "buddha": (1087716, (6.45, 14.14), (0.63, 1.53), (0.54, 0.59), (66.39, 16.60)),
}

# P. Bauszat, M. Eisemann, M. Magnor, "The Minimal Bounding Volume Hierarchy", VMV 2010, as quoted in the same slides. KiB of BVH,
# MVH and two-level MVH; then times of MVH and two-level MVH relative to the BVH, in the first and in the second half of their table (the
# slides do not name the rays of each half; the second half has many more rays for each node that is decoded).
MVH_PAPER = {
    "bones": (4204, (70.75, 0.51, 26.59), (27, 1.6), (3, 1.09)),
    "sponza": (67462, (797.94, 8.23, 41.02), (164, 7.5), (25, 1.71)),
    "dragon": (871414, (10.44 * 1024, 0.11 * 1024, 142.08), (131, 15.7), (11, 2.71)),
    "buddha": (1087716, (13.39 * 1024, 0.13 * 1024, 168.50), (94, 11.5), (6, 2.38)),
}


def run(*command):
    result = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE)
    if result.returncode != 0:
        sys.exit(f"compare_forms.py: failed: {' '.join(map(str, command))}")
    return result.stdout


def mean(values):
    """Returns the geometric mean."""
    return math.exp(sum(map(math.log, values)) / len(values))


def label(row):
    return f"{row['form']} {row['parameters']}".strip()


def measure(scene, tree, options, table):
    """Builds a tree. Returns the candidates' rows by name, and writes them to the table from which plots are drawn."""
    run("bvh-build", scene, *options["build"], "-o", tree)
    run("bvh-compress", tree, "--form", "aabb", "--codec", "none", "--pareto", table, "--count", options["rays"],
        "--repeat", options["repeat"], "-o", os.devnull)
    with open(table, newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["slowdown"]]
    for row in rows:
        for key, value in row.items():
            if key not in ("form", "parameters", "status"):
                row[key] = float(value)
    return {label(row): row for row in rows}


def columns(*cells):
    return "| " + " | ".join(cells) + " |"


def heading(*cells):
    return columns(*cells) + "\n|" + "---|" * len(cells)


def summary(scenes, key):
    """Returns a table of each form over all scenes: geometric means, and the worst slowdowns."""
    lines = [heading("form", "bytes per triangle", "NC", "BLB", "slowdown, primary", "slowdown, diffuse")]
    tables = [rows[key] for _, rows in scenes]
    for name in tables[0]:
        if any(name not in table for table in tables):
            continue  # not possible for one of the scenes
        cells = [name, f"{mean([table[name]['bytes_per_primitive'] for table in tables]):.3g}"]
        for column in ("NC", "BLB"):
            cells.append(f"{mean([table[name][column] / table['aabb'][column] for table in tables]):.2f}")
        for column in ("slowdown_primary", "slowdown_diffuse"):
            values = [table[name][column] for table in tables]
            cells.append(f"{mean(values):.2f} [{max(values):.2f}]")
        lines.append(columns(*cells))
    return "\n".join(lines) + "\n"


def details(rows):
    lines = [heading("form", "bytes per triangle", "NC", "BLB", "Mrays/s", "slowdown, primary", "slowdown, diffuse", "")]
    for name, row in rows.items():
        lines.append(columns(name, f"{row['bytes_per_primitive']:.3g}", f"{row['NC']:.1f}", f"{row['BLB']:.0f}",
                             f"{row['mrays_per_second']:.2f}", f"{row['slowdown_primary']:.2f}",
                             f"{row['slowdown_diffuse']:.2f}", "" if row["status"] == "dominated" else "frontier"))
    return "\n".join(lines) + "\n"


def ssh_beside_paper(name, triangles, rows, traced):
    paper = SSH_PAPER[name.lower()]
    lines = []
    for who, count, nodes, tests, speedup, size in (
            ("paper", paper[0], paper[1], paper[2], paper[3][0] / paper[3][1], paper[4]),
            ("here", triangles, [t["NC"] for t in traced], [t["TC"] for t in traced],
             1 / rows["ssh"]["slowdown_primary"], [t["bytes"]["nodes"] / 2**20 for t in traced])):
        lines.append(columns(name, who, f"{count:,}", *(f"{a:.2f} → {b:.2f}" for a, b in (nodes, tests)),
                             f"{speedup:.2f}", " → ".join(f"{mib:.2f}" for mib in size)))
    return lines


def two_level_of(rows):
    """Returns the two-level candidate with the least product of bytes and time, or None if no candidate can store the tree."""
    return min((row for row in rows.values() if row["form"] == "two-level"),
               key=lambda row: row["bytes_per_primitive"] * row["slowdown"], default=None)


def mvh_beside_paper(name, triangles, rows):
    count, sizes, first, second = MVH_PAPER[name.lower()]
    plain = rows["aabb"]["bytes_per_primitive"]
    lines = [columns(name, "paper", f"{count:,}", *(f"{1024 * size / count:.3f}" for size in sizes),
                     *(f"{sizes[0] / size:.0f}:1" for size in sizes[1:]),
                     *(f"{a:g} / {b:g}" for a, b in zip(first, second)))]
    pair = [rows["mvh"], two_level_of(rows)]
    lines.append(columns(name, "here", f"{triangles:,}", f"{plain:.3f}",
                         *(f"{row['bytes_per_primitive']:.3f}" for row in pair),
                         *(f"{plain / row['bytes_per_primitive']:.0f}:1" for row in pair),
                         *(f"{row['slowdown_primary']:.2f} / {row['slowdown_diffuse']:.2f}" for row in pair)))
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="NAME=SCENE")
    parser.add_argument("--rays", type=int, default=200000)
    parser.add_argument("--repeat", type=int, default=7)
    parser.add_argument("--table", help="the page to write the tables to; default: standard output")
    parser.add_argument("--plot", help="draw a plot of size against slowdown")
    options = parser.parse_args()
    if options.plot:
        require_matplotlib()
    for scene in options.scenes:
        if "=" not in scene:
            sys.exit(f"compare_forms.py: '{scene}' is not NAME=SCENE")

    scenes, ssh_lines, mvh_lines = [], [], []
    with tempfile.TemporaryDirectory() as work:
        plots = []
        for argument in options.scenes:
            name, scene = argument.split("=", 1)
            rows, traced, triangles = {}, [], 0
            for key, _, build in TREES:
                tree, table = os.path.join(work, "tree.bvhx"), os.path.join(work, f"{key}-{len(scenes)}.csv")
                rows[key] = measure(scene, tree, {"build": build, "rays": options.rays, "repeat": options.repeat}, table)
                if key == "single":
                    plots.append((name, table))
                    triangles = json.loads(run("bvh-stats", tree, "--no-epo", "--format", "json"))["primitives"]
                    if name.lower() in SSH_PAPER:
                        compact = os.path.join(work, "ssh.bvhx")
                        run("bvh-compress", tree, "--form", "ssh", "-o", compact)
                        traced = [json.loads(run("bvh-trace", path, "--resolution", "640x480", "--repeat", 1, "--format", "json"))
                                  for path in (tree, compact)]
            scenes.append((name, rows))
            if name.lower() in SSH_PAPER:
                ssh_lines += ssh_beside_paper(name, triangles, rows["single"], traced)
            if name.lower() in MVH_PAPER and "mvh" in rows["own"] and two_level_of(rows["own"]):
                mvh_lines += mvh_beside_paper(name, triangles, rows["own"])
        if options.plot:
            sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
            import plot_forms
            plot_forms.plot([(name, plot_forms.read(table)) for name, table in plots], options.plot)

    parts = []
    for key, title, _ in TREES:
        parts.append(f"## {title}\n\n" + summary(scenes, key))
    if ssh_lines:
        parts.append("## ssh and its paper\n\n" + heading("scene", "", "triangles", "nodes per ray, BVH → SSH",
                     "triangle tests per ray", "speed, SSH : BVH", "MiB") + "\n" + "\n".join(ssh_lines) + "\n")
    if mvh_lines:
        parts.append("## mvh, two-level and their paper\n\n" + heading("scene", "", "triangles", "BVH, bytes per triangle", "mvh", "two-level",
                     "BVH : mvh", "BVH : two-level", "slowdown, mvh", "slowdown, two-level") + "\n" + "\n".join(mvh_lines) + "\n")
    for name, rows in scenes:
        for key, title, _ in TREES:
            parts.append(f"## {name}: {title[0].lower() + title[1:]}\n\n" + details(rows[key]))
    text = "\n".join(parts)
    write_after_marker(options.table, MARKER, text)


if __name__ == "__main__":
    main()
