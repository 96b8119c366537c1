"""Malformed files of the aabb form (aabb.md) and of every tree (chunks.md)."""
import struct

import zstandard

from damage import COUNT, FIRST, NODE, case, hash64, simple

# The aabb form. two_triangles: node 0 is the root, nodes 2 and 3 are its leaves
simple(3001, "slot_1", lambda f: f.patch("NODE", NODE + 31, "B", 1))
simple(3001, "slot_1_negative_zero", lambda f: f.patch("NODE", NODE, "f", -0.0))
simple(3002, "odd_child", lambda f: f.patch("NODE", FIRST, "I", 3))
simple(3002, "child_out_of_range", lambda f: f.patch("NODE", FIRST, "I", 4))
simple(3002, "child_2_32", lambda f: f.patch("NODE", FIRST, "I", 2**32 - 2))
simple(3002, "own_child", lambda f: f.patch("NODE", FIRST, "I", 0))
simple(3002, "child_in_front", lambda f: f.patch("NODE", 2 * NODE + FIRST, "2I", 2, 0))
simple(3004, "leaf_out_of_range", lambda f: f.patch("NODE", 3 * NODE + FIRST, "I", 2))
simple(3004, "leaf_overflow", lambda f: f.patch("NODE", 3 * NODE + FIRST, "2I", 2**32 - 1, 2))
simple(3005, "overlap", lambda f: f.patch("NODE", 3 * NODE + FIRST, "I", 0))
simple(3005, "long_overlap", lambda f: f.patch("NODE", 2 * NODE + COUNT, "I", 2))
simple(3006, "primitive", lambda f: f.patch("PRIM", 4, "I", 2))
simple(3007, "missing_triangle", lambda f: (f.patch("PRIM", 4, "I", 0), f.patch("NODE", 3 * NODE, "6f", 0, 0, 0, 1, 1, 2))[0])
simple(3009, "depth", lambda f: f.patch("TREE", 32, "I", 2))
simple(4001, "nan_box", lambda f: f.patch("NODE", 2 * NODE + 4, "f", float("nan")))
simple(4001, "infinite_box", lambda f: f.patch("NODE", 12, "f", float("inf")))
simple(4001, "inverted_box", lambda f: f.patch("NODE", 2 * NODE + 8, "f", 0.5))
simple(4002, "child_outside", lambda f: f.patch("NODE", 3 * NODE + 20, "f", 2.5))
simple(4003, "triangle_outside", lambda f: f.patch("NODE", 3 * NODE + 20, "f", 1.5))
simple(4003, "split_triangle_outside", lambda f: f.patch("NODE", 3 * NODE + 12, "f", 3.5), "split_triangle")
simple(4003, "split_triangle_apart", lambda f: f.patch("NODE", 3 * NODE, "6f", 0, 0, 0, 4, 1, 0) and
       f.patch("NODE", 2 * NODE, "6f", 1.5, 0, 0, 2, 1, 0), "split_triangle")


def rebuild(f, nodes, primitives, vertices=None, triangles=None, depth=None):
    """Replaces the tree by a list of (box, first, count), over the file's or another geometry."""
    if vertices:
        f.replace("VERT", b"".join(struct.pack("<3f", *v) for v in vertices))
        f.replace("TRIS", b"".join(struct.pack("<3I", *t) for t in triangles))
        f.patch("SCEN", 0, "2Q", len(vertices), len(triangles)).patch("GEOM", 0, "I", len(triangles))
    f.replace("NODE", b"".join(struct.pack("<6f2I", *box, first, count) for box, first, count in nodes))
    f.replace("PRIM", struct.pack(f"<{len(primitives)}I", *primitives))
    f.patch("TREE", 8, "2Q", len(nodes), len(primitives)).patch("TREE", 32, "I", depth)


POINT = (1, 1, 1)
POINTS = (*POINT, *POINT)
UNUSED = ((0,) * 6, 0, 0)


def points(count):
    """Returns a geometry of `count` triangles that are all the same point."""
    return {"vertices": [POINT], "triangles": [(0, 0, 0)] * count}


@case(3003, "shared_children")
def shared_children(f):
    # Nodes 2 and 3 both have children 4 and 5; nodes 6 and 7 have no parent.
    nodes = [(POINTS, 2, 0), UNUSED, (POINTS, 4, 0), (POINTS, 4, 0), (POINTS, 0, 1), (POINTS, 1, 1), (POINTS, 2, 1), (POINTS, 3, 1)]
    rebuild(f, nodes, [0, 1, 2, 3], depth=2, **points(4))


@case(3003, "orphans")
def orphans(f):
    nodes = [(POINTS, 2, 0), UNUSED, (POINTS, 0, 1), (POINTS, 1, 1), (POINTS, 2, 1), (POINTS, 3, 1)]
    rebuild(f, nodes, [0, 1, 2, 3], depth=1, **points(4))


@case(3004, "leaf_too_large")
def leaf_too_large(f):
    # Runs of 16 entries, compressed: a small file within the limit of expansion.
    entries = [hash64(struct.pack("<I", i // 16)) % 64 for i in range(65536)]
    rebuild(f, [(POINTS, 0, 65536), UNUSED], entries, depth=0, **points(64))
    f["PRIM"].codec, f["PRIM"].stored = 1, zstandard.compress(f["PRIM"].raw)


@case(3005, "gap")
def gap(f):
    nodes = [(POINTS, 2, 0), UNUSED, (POINTS, 0, 1), (POINTS, 2, 1)]
    rebuild(f, nodes, [0, 1, 1], depth=1, **points(2))


@case(3008, "depth_97")
def too_deep(f):
    nodes, levels = [(POINTS, 2, 0), UNUSED], 97
    for level in range(levels):
        nodes.append((POINTS, level, 1))
        last = level + 1 == levels
        nodes.append((POINTS, levels, 1) if last else (POINTS, len(nodes) + 1, 0))
    rebuild(f, nodes, list(range(levels + 1)), depth=96, **points(levels + 1))
