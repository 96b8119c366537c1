#!/usr/bin/env python3
"""Compares all builders and restructurers by the time that they take and by the cost of tracing their trees.

Usage: compare_methods.py [--rounds N] [--rays N] [--chains CHAIN,...] [--table FILE.md] [--plot FILE.png] SCENE...

A chain is BUILDER, or BUILDER+METHOD[:ITERATIONS]. Without --chains every builder runs alone and with every method of
bvh-restructure. In each round every chain runs once, so that disturbances of the machine affect all chains. Times and rates are
medians over the rounds, of the passes themselves, without reading and writing files. Trees are built for SAH costs of 1 and 1.
The tools must be on PATH; --plot needs matplotlib (Debian: python3-matplotlib). --table keeps a page up to its line
<!-- compare_methods.py writes what follows -->.
"""
import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

from page import require_matplotlib, write_after_marker

COLUMNS = [  # key, heading, format
    ("chain", "builder + method", "{}"),
    ("seconds", "seconds", "{:.3f}"),
    ("sah", "SAH", "{:.2f}"),
    ("epo", "EPO", "{:.2f}"),
    ("references", "references", "{:.2f}"),
    ("NC", "NC", "{:.1f}"),
    ("TC", "TC", "{:.2f}"),
    ("mrays", "diffuse Mrays/s", "{:.2f}"),
]
MARKER = "<!-- compare_methods.py writes what follows -->"
COLOURS = ["#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb"]
MARKS = "osD^vP*X"


def run(*command):
    result = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE)
    if result.returncode != 0:
        sys.exit(f"compare_methods.py: failed: {' '.join(map(str, command))}")
    return result.stdout


def run_json(*command):
    return json.loads(run(*command, "--format", "json"))


def choices(tool, option):
    """Returns the names that an option takes, as listed by the tool's --help."""
    lines = run(tool, "--help").decode().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith(f"  {option} "))
    names = []
    for line in lines[start + 1:]:
        if not line.startswith(" " * 36):
            break
        match = re.match(r" {36}([a-z0-9-]+)  ", line)
        if match:  # other lines continue a summary
            names.append(match.group(1))
    return names


def all_chains():
    methods = [name for name in choices("bvh-restructure", "--method") if name != "none"]
    return [chain for builder in choices("bvh-build", "--builder")
            for chain in [builder] + [f"{builder}+{method}" for method in methods]]


def make(chain, scene, work):
    """Runs a chain. Returns the container and the seconds that its passes took."""
    builder, *steps = chain.split("+")
    tree, report = os.path.join(work, "tree.bvhx"), os.path.join(work, "report.json")
    seconds = 0

    def run_pass(*command):
        nonlocal seconds
        run(*command, "-o", tree, "--report", report)
        with open(report) as file:
            seconds += json.load(file)["seconds"]

    run_pass("bvh-build", scene, "--builder", builder, "--traversal-cost", 1, "--intersection-cost", 1)
    for step in steps:
        method, _, iterations = step.partition(":")
        run_pass("bvh-restructure", tree, "--method", method, *(("--iterations", iterations) if iterations else ()))
    return tree, seconds


def measure(scene, chains, rounds, rays, work):
    rows = {chain: {"chain": chain.replace("+", " + ")} for chain in chains}
    samples = {chain: ([], []) for chain in chains}
    for turn in range(rounds):
        for chain in chains:
            tree, seconds = make(chain, scene, work)
            traced = run_json("bvh-trace", tree, "--rays", "diffuse", "--count", rays, "-j", 1)
            samples[chain][0].append(seconds)
            samples[chain][1].append(traced["mrays_per_second"])
            if turn == 0:
                stats = run_json("bvh-stats", tree)
                rows[chain].update(sah=stats["sah_cost"], epo=stats["epo"], NC=traced["NC"], TC=traced["TC"],
                                   hash=traced["hit_hash"], references=stats["references"] / stats["primitives"])
    for chain in chains:
        rows[chain]["seconds"] = statistics.median(samples[chain][0])
        rows[chain]["mrays"] = statistics.median(samples[chain][1])
    if len({row["hash"] for row in rows.values()}) != 1:
        sys.exit(f"compare_methods.py: {scene}: the chains' trees do not find the same hits")
    return list(rows.values())


def table(title, rows):
    lines = [f"### {title}", "", "| " + " | ".join(heading for _, heading, _ in COLUMNS) + " |", "|---" * len(COLUMNS) + "|"]
    for row in rows:
        lines.append("| " + " | ".join(text.format(row[key]) for key, _, text in COLUMNS) + " |")
    return "\n".join(lines) + "\n"


def plot(scenes, path):
    """Draws cost against time for each scene, with builders as colours and methods as marks. Nearer to the lower left corner is
    better."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    columns = min(len(scenes), 3)
    lines = -(-len(scenes) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(4.6 * columns, 3.9 * lines), squeeze=False)
    for axis in axes.flat[len(scenes):]:
        axis.set_visible(False)
    chains = [row["chain"].split(" + ", 1) for row in scenes[0][1]]
    builders = list(dict.fromkeys(chain[0] for chain in chains))
    methods = list(dict.fromkeys(chain[1] if len(chain) > 1 else "" for chain in chains))
    for axis, (title, rows) in zip(axes.flat, scenes):
        for builder in builders:
            colour = COLOURS[builders.index(builder) % len(COLOURS)]
            points = []
            for row in rows:
                name, _, method = row["chain"].partition(" + ")
                if name == builder:
                    points.append((row["seconds"], row["sah"], method))
            axis.plot(*zip(*((x, y) for x, y, _ in sorted(points))), color=colour, linewidth=0.8, alpha=0.5)
            for x, y, method in points:
                axis.scatter(x, y, color=colour, marker=MARKS[methods.index(method) % len(MARKS)], s=34, zorder=3)
        # Chains that cost almost twice the best would leave no room for the others.
        costs = [row["sah"] for row in rows]
        axis.set_ylim(0.97 * min(costs), 1.03 * min(max(costs), 1.75 * min(costs)))
        axis.set_title(title, fontsize=10)
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.yaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda y, _: f"{y:g}"))
        axis.yaxis.set_minor_formatter(matplotlib.ticker.FuncFormatter(lambda y, _: f"{y:g}"))
        axis.tick_params(labelsize=8, which="both")
        axis.grid(True, which="both", linewidth=0.4, color="#dddddd")
        axis.set_xlabel("seconds to build and restructure", fontsize=8)
        axis.set_ylabel("SAH cost", fontsize=8)
    handle = matplotlib.lines.Line2D
    handles = [handle([], [], color=COLOURS[i % len(COLOURS)], marker="o", linestyle="-", linewidth=0.8, label=name)
               for i, name in enumerate(builders)]
    handles += [handle([], [], color="#333333", marker=MARKS[i % len(MARKS)], linestyle="", label=name or "as built")
                for i, name in enumerate(methods)]
    figure.legend(handles=handles, loc="lower center", ncol=len(handles), fontsize=8, frameon=False)
    figure.tight_layout(rect=(0, 0.32 / (3.9 * lines), 1, 1))
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="SCENE")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--rays", type=int, default=300000)
    parser.add_argument("--chains", help="chains, separated by commas; default: all")
    parser.add_argument("--table", help="the page to write the tables to; default: standard output")
    parser.add_argument("--plot", help="draw a plot of cost against time")
    options = parser.parse_args()
    if options.plot:
        require_matplotlib()

    chains = options.chains.split(",") if options.chains else all_chains()
    scenes = []
    with tempfile.TemporaryDirectory() as work:
        for scene in options.scenes:
            rows = measure(scene, chains, max(1, options.rounds), options.rays, work)
            scenes.append((os.path.splitext(os.path.basename(scene))[0], rows))
    text = "\n".join(table(title, rows) for title, rows in scenes)
    write_after_marker(options.table, MARKER, text)
    if options.plot:
        plot(scenes, options.plot)


if __name__ == "__main__":
    main()
