#!/usr/bin/env python3
"""Compares every layout with depth-first order, by a model of caches and by time.

Usage: compare_layouts.py [--rays N] [--repeat N] [--rounds N] [--layouts NAMES] [--table FILE.md] [--plot FILE.png] NAME=SCENE...

For each scene a tree with one triangle per leaf is built, and put into every layout of bvh-relayout (by areas, and by visits if a layout
uses them). It is traced with the same diffuse rays, in the order of the picture's pixels and shuffled: with nodes in 64-byte records (the
aabb form), in 16-byte records (the quantized form) and, only in the model, in records of 8 bytes. Times are on one thread, the fastest of
--rounds times --repeat runs; each round goes through all layouts in turn. The tools must be on PATH; --plot needs matplotlib (Debian:
python3-matplotlib) and draws the first scene. --table keeps a page up to its line <!-- compare_layouts.py writes what follows -->.
"""
import argparse
import csv
import itertools
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile

from page import require_matplotlib, write_after_marker

MARKER = "<!-- compare_layouts.py writes what follows -->"
LINES = [64, 128]
ORDERS = ["given", "shuffled"]
BASE = "dfs"
BUNDLE = 24  # rays of the picture

# Records of 8 bytes on lines of L bytes in a cache of S bytes have the same misses as records of 16 bytes on lines of 2 L bytes in a cache
# of 2 S bytes, where everything is twice as large.
KINDS = [  # key, heading, bytes of a record, options of bvh-compress, bytes that are stored for each byte modelled
    ("64", "64-byte records: aabb", 64, ["--form", "aabb"], 1),
    ("16", "16-byte records: quantized", 16, ["--form", "quantized"], 1),
    ("8", "8-byte records, if pointers were free", 8, ["--form", "quantized"], 2),
]
NOTES = {  # printed below the table of a kind if all layouts that the note names were compared
    "64": (("odfs", "tbfs"), "The treelets of **tbfs** have as many records as fit into a line. A 64-byte record fills a line of 64 bytes, so each treelet "
                             "is one pair, and **tbfs** equals **odfs** except for lines of 128 bytes."),
}
CUBE = """v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 3 4\n"""


def run(*command, allowed=(0,)):
    result = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if result.returncode not in allowed:
        sys.exit(f"compare_layouts.py: failed: {' '.join(map(str, command))}: {result.stderr.strip()}")
    return result


def mean(values):
    """Returns the geometric mean, or 0 if a value is 0."""
    return math.exp(sum(map(math.log, values)) / len(values)) if min(values) > 0 else 0


def ratio(own, base):
    return own / base if base > 0 else 1 if own == 0 else math.inf


def columns(*cells):
    return "| " + " | ".join(cells) + " |"


def heading(*cells):
    return columns(*cells) + "\n|" + "---|" * len(cells)


def has_option(tool, option):
    return re.search(rf"^\s+{option}\b", run(tool, "--help").stdout, re.MULTILINE) is not None


def names_of(tool, option):
    """Returns the names that --help lists below an option."""
    names, inside = [], False
    for line in run(tool, "--help").stdout.splitlines():
        if re.match(r"^  -", line):
            inside = option in line.split()
        elif inside and (name := re.match(r"^ {36}([a-z0-9-]+)  ", line)):
            names.append(name.group(1))
    return names


class Variant:
    """A layout, whether it is driven by visits, and the options of bvh-relayout that it uses."""

    def __init__(self, layout, by_visits, uses):
        self.layout, self.by_visits, self.uses = layout, by_visits, uses
        self.name = layout + (" by visits" if by_visits else "")

    def options(self, record, line):
        values = {"--record-bytes": record, "--line-size": line, "--probability": "visits"}
        return [part for option in self.uses for part in (option, values[option])]


def variants(layouts, work):
    """Returns the variants of layouts, by areas and by visits. Finds the options that each layout uses by trying: unused ones are rejected."""
    mesh, tree = os.path.join(work, "small.obj"), os.path.join(work, "small.bvhx")
    with open(mesh, "w") as file:
        file.write(CUBE)
    run("bvh-build", mesh, "--max-leaf-size", 1, "-o", tree)
    visits = has_option("bvh-trace", "--record-visits") and has_option("bvh-relayout", "--probability")
    if visits:
        run("bvh-trace", tree, "--count", 12, "--repeat", 1, "--record-visits", tree, "-o", os.devnull)
    found = []
    for layout in layouts:
        tried = [("--record-bytes", 16), ("--line-size", 64)] + ([("--probability", "visits")] if visits else [])
        uses = [option for option, value in tried
                if run("bvh-relayout", tree, "--layout", layout, option, value, "-o", os.devnull, allowed=(0, 1)).returncode == 0]
        found.append(Variant(layout, False, [option for option in uses if option != "--probability"]))
        if "--probability" in uses:
            found.append(Variant(layout, True, uses))
    return found


def caches(lines, scale):
    """Returns caches of 32 KiB and 1 MiB for each length of lines, and the pages of a TLB with 64 entries."""
    kinds = [f"{32 * scale}K:{line * scale}:8,{scale}M:{line * scale}:16" for line in lines]
    return "+".join(kinds + [f"{256 * scale}K:{4 * scale}K:64"])


def trace(container, rays, order, repeat, *more):
    report = run("bvh-trace", container, "--rays", rays, "--ray-order", order, "--repeat", repeat, "-j", 1, "--format", "json", *more)
    return json.loads(report.stdout)


def figures(report, lines, scale):
    """Returns the figures of one trace for the tables, by (measure, line) or measure."""
    nodes, values = report["cache"]["nodes"], {}
    for i, line in enumerate(lines):
        for level in (1, 2):
            row = nodes[2 * i + level - 1]
            values[f"L{level}", line] = row["misses_per_ray"]
            values[f"B{level}", line] = row["bytes_per_ray"] / scale
    values["TLB"] = nodes[-1]["misses_per_ray"]
    if scale == 1:
        values["LJC"] = report["LJC"]["4096"]
        values["CMC"] = report["CMC"]["4096"]
    return values


class Row:
    """The figures of a variant for one scene and kind of record, by order of rays."""

    def __init__(self):
        self.figures = {order: {} for order in ORDERS}
        self.rate = {}
        self.containers = {}  # by length of lines

    def time(self, rays, repeat, *more):
        for order in ORDERS:
            report = trace(self.containers[LINES[0]], rays, order, repeat, *more)
            rate = report["rays"] / 1e6 / max(report["processor_seconds"], 1e-6)
            self.rate[order] = max(self.rate.get(order, 0), rate)


def lay_out(tree, variant, record, line, compress, container):
    run("bvh-relayout", tree, "--layout", variant.layout, *variant.options(record, line), "-o", container)
    run("bvh-compress", container, *compress, "--codec", "none", "-o", container)


def measure(tree, rays, found, kind, options, work):
    """Returns a row for each variant."""
    key, _, record, compress, scale = kind
    rows = {}
    for i, variant in enumerate(found):
        row = rows[variant.name] = Row()
        # A layout that does not use the line size is the same for all sizes.
        for lines in ([[line] for line in LINES] if "--line-size" in variant.uses else [LINES]):
            container = os.path.join(work, f"{key}-{i}-{lines[0]}.bvhx")
            lay_out(tree, variant, record, lines[0], compress, container)
            row.containers.update({line: container for line in lines})
            for order in ORDERS:
                report = trace(container, rays, order, 1, "--cache", caches(lines, scale))
                seen = figures(report, lines, scale)
                row.figures[order] = {**seen, **row.figures[order]}
    if scale == 1:  # the containers are those that are modelled
        for _, row in itertools.product(range(options.rounds), rows.values()):
            row.time(rays, options.repeat)
    for row in rows.values():
        for container in set(row.containers.values()):
            os.remove(container)
    return rows


def ratio_tables(scenes, found):
    parts = []
    for key, title, _, _, scale in KINDS:
        titles = [f"L1 misses, lines of {line}" for line in LINES] + [f"L2 misses, lines of {LINES[0]}", "TLB misses"]
        measures = [("L1", line) for line in LINES] + [("L2", LINES[0]), "TLB"] + (["LJC"] if scale == 1 else [])
        titles += ["LJC 4096", "time", "time, worst scene"] if scale == 1 else []
        lines = [heading("layout", *titles)]
        for variant in found:
            cells = [variant.name]
            pairs = [(rows[key][variant.name], rows[key][BASE]) for _, rows in scenes]
            for name in measures:
                cells.append(" / ".join(f"{mean([ratio(own.figures[order][name], base.figures[order][name]) for own, base in pairs]):.2f}"
                                        for order in ORDERS))
            if scale == 1:
                for combine in (mean, max):
                    cells.append(" / ".join(f"{combine([base.rate[order] / own.rate[order] for own, base in pairs]):.2f}"
                                            for order in ORDERS))
            lines.append(columns(*cells))
        names, note = NOTES.get(key, ((), ""))
        if note and all(name in {variant.layout for variant in found} for name in names):
            lines += ["", note]
        parts.append(f"## {title}\n\n" + "\n".join(lines) + "\n")
    return parts


def scene_tables(name, tables, found):
    parts = []
    for key, title, _, _, scale in KINDS:
        titles = [f"L{level} misses, bytes; lines of {line}" for line in LINES for level in (1, 2)] + ["TLB misses"]
        lines = [heading("layout", *titles, *(["LJC 4096", "CMC 4096", "Mrays/s"] if scale == 1 else []))]
        for variant in found:
            row = tables[key][variant.name]

            def cell(write):
                return " / ".join(write(row.figures[order]) for order in ORDERS)

            cells = [cell(lambda seen, at=(level, line): f"{seen[f'L{at[0]}', at[1]]:.2f}, {seen[f'B{at[0]}', at[1]]:.0f}")
                     for line in LINES for level in (1, 2)]
            cells.append(cell(lambda seen: f"{seen['TLB']:.2f}"))
            if scale == 1:
                cells += [cell(lambda seen, at=at: f"{seen[at]:.1f}") for at in ("LJC", "CMC")]
                cells.append(" / ".join(f"{row.rate[order]:.3f}" for order in ORDERS))
            lines.append(columns(variant.name, *cells))
        parts.append(f"## {name}, {title}\n\n" + "\n".join(lines) + "\n")
    return parts


POINTER_BITS = [6, 8, 10]


def has_short_records(layouts):
    return "quantized-short" in names_of("bvh-compress", "--form") and "clusters" in layouts


def measure_short(tree, rays, options, work):
    """Returns a table of real 8-byte records, by the bits of their pointers."""
    rows = {}
    for bits in POINTER_BITS:
        container, report = os.path.join(work, "short.bvhx"), os.path.join(work, "report.json")
        run("bvh-relayout", tree, "--layout", "clusters", "--pointer-bits", bits, "--report", report, "-o", container)
        run("bvh-compress", container, "--form", "quantized-short", "--codec", "none", "-o", container)
        row = rows[bits] = Row()
        row.containers = {line: container for line in LINES}
        with open(report) as file:
            row.clusters = json.load(file).get("clusters", {})
        for order in ORDERS:
            row.figures[order] = figures(trace(container, rays, order, 1, "--cache", caches(LINES, 1)), LINES, 1)
        for _ in range(options.rounds):
            row.time(rays, options.repeat)
    return rows


def short_table(scenes):
    lines = [heading("pointer bits", "bytes of slots per record", "glue", "bytes per ray, relative to 64-byte dfs", "L1 misses, relative to 64-byte dfs",
                     "L1 misses, relative to 16-byte dfs", "time, relative to 64-byte dfs", "time, relative to 16-byte dfs")]
    for bits in POINTER_BITS:
        rows = [(tables["short"][bits], tables["64"][BASE], tables["16"][BASE]) for _, tables in scenes]
        clusters = [row.clusters for row, _, _ in rows]

        def misses(at, to):
            return " / ".join(f"{mean([ratio(row[0].figures[order][at], row[to].figures[order][at]) for row in rows]):.3f}"
                              for order in ORDERS)

        def time(to):
            return " / ".join(f"{mean([row[to].rate[order] / row[0].rate[order] for row in rows]):.2f}" for order in ORDERS)

        lines.append(columns(str(bits), f"{mean([c['bytes_per_record'] for c in clusters]):.2f}",
                             f"{100 * sum(c['glue_share'] for c in clusters) / len(clusters):.2f}%",
                             misses(("B1", LINES[0]), 1), misses(("L1", LINES[0]), 1), misses(("L1", LINES[0]), 2), time(1), time(2)))
    return "## clusters: 8-byte records with short pointers\n\n" + "\n".join(lines) + "\n"


def measure_storages(tree, rays, options):
    """Returns a table of ways to store the nodes of the aabb form in memory, by name."""
    rows = {}
    for storage in names_of("bvh-trace", "--node-storage"):
        row = rows[storage] = Row()
        row.containers = {line: tree for line in LINES}
        for order in ORDERS:
            report = trace(tree, rays, order, 1, "--node-storage", storage, "--cache", caches(LINES, 1))
            row.figures[order] = {**figures(report, LINES, 1), "bytes": report["bytes"]["nodes"] / 2**20}
    for _, (storage, row) in itertools.product(range(options.rounds), rows.items()):
        row.time(rays, options.repeat, "--node-storage", storage)
    return rows


def storage_table(scenes):
    lines = [heading("node storage", "bytes", *(f"L1 misses, lines of {line}" for line in LINES), "TLB misses", "LJC 4096", "time",
                     "time, worst scene")]
    tables = [tables["storages"] for _, tables in scenes]
    for storage in tables[0]:
        pairs = [(table[storage], table["pairs"]) for table in tables]
        cells = [storage, f"{mean([ratio(own.figures['given']['bytes'], base.figures['given']['bytes']) for own, base in pairs]):.2f}"]
        for at in [("L1", line) for line in LINES] + ["TLB", "LJC"]:
            cells.append(" / ".join(f"{mean([ratio(own.figures[order][at], base.figures[order][at]) for own, base in pairs]):.2f}"
                                    for order in ORDERS))
        for combine in (mean, max):
            cells.append(" / ".join(f"{combine([base.rate[order] / own.rate[order] for own, base in pairs]):.2f}" for order in ORDERS))
        lines.append(columns(*cells))
    return "## Node storage of the aabb form, depth first, relative to sibling pairs\n\n" + "\n".join(lines) + "\n"


def bundle_of(rays, path):
    """Writes a few neighbouring rays of a set as a set of their own."""
    with open(rays, "rb") as file:
        data = file.read()
    count = struct.unpack_from("<Q", data, 8)[0]
    first, size = count // 2, min(BUNDLE, count)
    first = min(first, count - size)
    with open(path, "wb") as file:
        file.write(data[:8] + struct.pack("<Q", size) + data[16 + 32 * first:16 + 32 * (first + size)])


def fetched_addresses(tree, rays, found, work):
    """Returns for each variant, in 16-byte records, the ray and the offset of each fetch of a node, and the bytes of all nodes."""
    bundle, table, container = (os.path.join(work, name) for name in ("bundle.rays", "fetches.csv", "drawn.bvhx"))
    bundle_of(rays, bundle)
    drawn = []
    for variant in found:
        lay_out(tree, variant, 16, LINES[0], ["--form", "quantized"], container)
        report = trace(container, bundle, "given", 1, "--fetches", table)
        with open(table, newline="") as file:
            fetches = [(int(row["ray"]), int(row["offset"])) for row in csv.DictReader(file) if row["array"] == "nodes"]
        drawn.append((variant.name, fetches, report["bytes"]["nodes"]))
    return drawn


def plot(name, drawn, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    width = min(4, len(drawn))
    figure, axes = plt.subplots(-(-len(drawn) // width), width, figsize=(2.6 * width, 1.9 * -(-len(drawn) // width) + 0.4),
                                sharex=True, sharey=True, squeeze=False, layout="constrained")
    for axis in axes.flat[len(drawn):]:
        axis.set_visible(False)
    for axis, (variant, fetches, size) in zip(axes.flat, drawn):
        axis.scatter(range(len(fetches)), [offset / 2**20 for _, offset in fetches], c=[ray % 2 for ray, _ in fetches],
                     cmap=matplotlib.colors.ListedColormap(["#4477aa", "#ee6677"]), s=3, linewidths=0)
        axis.set_title(variant, fontsize=8, pad=2)
        axis.set_ylim(-0.02 * size / 2**20, 1.02 * size / 2**20)
        axis.tick_params(labelsize=6)
    figure.supxlabel("node fetches, one after the other", fontsize=8)
    figure.supylabel("address, MiB", fontsize=8)
    figure.suptitle(f"{name}: {BUNDLE} neighbouring diffuse rays, in two colours by turns", fontsize=9)
    figure.savefig(path, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="NAME=SCENE")
    parser.add_argument("--rays", type=int, default=100000)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--layouts", help="only these layouts, separated by commas; dfs is always included")
    parser.add_argument("--table", help="the page to write the tables to; default: standard output")
    parser.add_argument("--plot", help="draw a plot of the fetched addresses")
    options = parser.parse_args()
    if options.plot:
        require_matplotlib()
    for scene in options.scenes:
        if "=" not in scene:
            sys.exit(f"compare_layouts.py: '{scene}' is not NAME=SCENE")

    layouts = [name for name in names_of("bvh-relayout", "--layout")
               if not options.layouts or name == BASE or name in options.layouts.split(",")]
    scenes = []
    with tempfile.TemporaryDirectory() as work:
        found = variants(layouts, work)
        for argument in options.scenes:
            name, scene = argument.split("=", 1)
            tree, rays = os.path.join(work, "tree.bvhx"), os.path.join(work, "diffuse.rays")
            run("bvh-build", scene, "--max-leaf-size", 1, "-o", tree)
            visits = ["--record-visits", tree] if any(variant.by_visits for variant in found) else []
            run("bvh-trace", tree, "--rays", "diffuse", "--count", options.rays, "--repeat", 1, "--save-rays", rays, *visits, "-o", os.devnull)
            if options.plot and not scenes:
                drawn = [variant for variant in found if not variant.by_visits]
                plot(name, fetched_addresses(tree, rays, drawn, work), options.plot)
            tables = {kind[0]: measure(tree, rays, found, kind, options, work) for kind in KINDS}
            tables["storages"] = measure_storages(tree, rays, options)
            if has_short_records(layouts):
                tables["short"] = measure_short(tree, rays, options, work)
            scenes.append((name, tables))

    parts = ratio_tables(scenes, found)
    if "short" in scenes[0][1]:
        parts.append(short_table(scenes))
    parts.append(storage_table(scenes))
    for name, tables in scenes:
        parts += scene_tables(name, tables, found)
    text = "\n".join(parts)
    write_after_marker(options.table, MARKER, text)


if __name__ == "__main__":
    main()
