#!/usr/bin/env python3
"""Draws the tables of bvh-compress --pareto: bytes per triangle against slowdown, one panel per file.

Usage: plot_forms.py TABLE.csv... -o PLOT.png    (any format that matplotlib writes: .png, .svg, .pdf)

Needs matplotlib (Debian: python3-matplotlib; samples/setup.sh plots). The title of a panel is the name of its file. The line joins
the forms that no other form beats in both size and time, labelled with the values of their parameters. Nearer to the lower left
corner is better.
"""
import argparse
import csv
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = ["#222222", "#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb"]

TICKS_OF_SIZE = [4.0**k for k in range(-3, 6)]
TICKS_OF_TIME = [0.6, 0.8, 1, 1.2, 1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 512, 1024]


def read(path):
    with open(path, newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["slowdown"]]
    for row in rows:
        row["x"], row["y"] = float(row["bytes_per_primitive"]), float(row["slowdown"])
    return rows


def draw(axis, title, rows, colours):
    frontier = sorted((row["x"], row["y"]) for row in rows if row["status"] != "dominated")
    axis.plot(*zip(*frontier), color="#999999", linewidth=1, zorder=1)
    for form, colour in colours.items():
        points = [row for row in rows if row["form"] == form]
        axis.scatter([row["x"] for row in points], [row["y"] for row in points], color=colour, s=30, label=form, zorder=3)
    for row in rows:
        if row["status"] == "chosen":
            axis.scatter(row["x"], row["y"], s=120, facecolors="none", edgecolors="black", zorder=2)
        if row["status"] != "dominated" and row["parameters"]:
            axis.annotate(" ".join(row["parameters"].split()[1::2]), (row["x"], row["y"]), fontsize=6,
                          xytext=(4, 4), textcoords="offset points")
    for scale, ticks in ((axis.xaxis, TICKS_OF_SIZE), (axis.yaxis, TICKS_OF_TIME)):
        scale.axes.set(**{f"{scale.axis_name}scale": "log"})
        scale.set_major_locator(matplotlib.ticker.FixedLocator(ticks))
        scale.set_minor_locator(matplotlib.ticker.NullLocator())
        scale.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%.3g"))
    axis.set_title(title, fontsize=10)
    axis.set_xlabel("node bytes per triangle")
    axis.set_ylabel("time over that of the aabb form")
    axis.grid(True, which="major", color="#eeeeee")
    axis.set_axisbelow(True)


def plot(tables, path):
    """Draws a panel for each pair (title, rows)."""
    forms = list(dict.fromkeys(row["form"] for _, rows in tables for row in rows))
    colours = {form: COLOURS[i % len(COLOURS)] for i, form in enumerate(forms)}
    columns = min(len(tables), 3)
    lines = -(-len(tables) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(4.8 * columns, 4.0 * lines), squeeze=False)
    for axis in axes.flat[len(tables):]:
        axis.set_visible(False)
    for axis, (title, rows) in zip(axes.flat, tables):
        draw(axis, title, rows, colours)
    axes.flat[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("tables", nargs="+", metavar="TABLE.csv")
    parser.add_argument("-o", "--output", required=True, metavar="PLOT.png")
    options = parser.parse_args()

    plot([(os.path.splitext(os.path.basename(path))[0], read(path)) for path in options.tables], options.output)


if __name__ == "__main__":
    main()
