"""Meshes placed many times, and trees over them: instances.md."""
import math
import struct

from boxes import around
from clauses import reject_if
from floats import round_down
from tree import check_tree
from two_level import read_levels


def read_instances(chunks, scene, counts, meshes, instances):
    """Adds "runs", a pair of first triangle and count for each mesh, and "placed", a pair of mesh and box in the world for each instance."""
    geometry, triangle, runs = 0, 0, []
    sizes = [size for size, in struct.iter_unpack("<I", chunks.expect("MESH", 4 * meshes))]
    for size in sizes:
        count = sum(counts[geometry:geometry + size])
        reject_if(geometry + size > len(counts) or count == 0, 2017, "a mesh")
        runs.append((triangle, count))
        geometry, triangle = geometry + size, triangle + count
    reject_if(geometry != len(counts), 2017, "meshes")
    mesh_boxes = [around(scene["boxes"][first:first + count]) for first, count in runs]
    placed, next_geometry, primitives = [], 0, 0
    for record in struct.iter_unpack("<12f4I", chunks.expect("INST", 64 * instances)):
        m, (mesh, first_geometry, *reserved) = record[:12], record[12:]
        reject_if(any(reserved), 2006, "INST: reserved")
        reject_if(not all(map(math.isfinite, m)), 4007, "a transform is not finite")
        a, b, c, _, d, e, f, _, g, h, i, _ = m
        reject_if(a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g) == 0, 4007, "a transform")
        reject_if(mesh >= meshes, 2018, "mesh of an instance")
        reject_if(first_geometry < next_geometry or first_geometry + sizes[mesh] > 2**32 - 1, 2018, "geometries of an instance")
        next_geometry = first_geometry + sizes[mesh]
        primitives += runs[mesh][1]
        reject_if(primitives >= 2**31, 2018, "primitives")
        placed.append((mesh, placed_box(m, mesh_boxes[mesh])))
    scene["runs"], scene["placed"], scene["mesh_boxes"] = runs, placed, mesh_boxes


def placed_box(m, box):
    box_min, box_max = [], []
    for row in range(3):
        numbers, t = m[4 * row:4 * row + 3], m[4 * row + 3]
        low = high = size = 0.0
        for axis, number in enumerate(numbers):
            low += min(number * box[axis], number * box[axis + 3])
            high += max(number * box[axis], number * box[axis + 3])
            size += abs(number) * max(abs(box[axis]), abs(box[axis + 3]))
        margin = (size + abs(t)) * 2.0**-18
        box_min.append(round_down(low + t - margin))
        box_max.append(-round_down(-(high + t + margin)) + 0.0)
    return box_min + box_max


def check_instanced(chunks, slots, references, stated_depth, scene):
    """The trees of instances.md 4."""
    nodes, roots, below, raw, entries = read_levels(chunks, slots, references, scene)
    boxes = [box for _, box in scene["placed"]]
    depths = [check_tree(nodes, entries, len(nodes), len(boxes), None, {"triangles": len(boxes), "boxes": boxes})]
    primitives, slot, entry = struct.unpack(f"<{references}I", raw), 0, 0
    for root, (first, count) in zip(roots, scene["runs"]):
        start, pairs, entries = slot, int(root[7] == 0), root[7]
        while slot < start + 2 * pairs:
            reject_if(slot >= len(below), 3003, "nodes of a BLAS")
            entries += below[slot][7]
            pairs += below[slot][7] == 0
            slot += 1
        reject_if(entry + entries > references, 3003, "entries of a BLAS")
        tree = [(*n[:6], n[6] - (entry if n[7] else start - 2), n[7]) for n in [root] + below[start:slot]]
        reject_if(any(n[6] < 0 for n in tree), 3003, "a BLAS reaches into another")
        own = [p - first for p in primitives[entry:entry + entries]]
        reject_if(any(p < 0 for p in own), 3006, "an entry of another mesh")
        own = struct.pack(f"<{entries}I", *own)
        depths.append(check_tree(tree[:1] + [(0,) * 8] + tree[1:], own, 2 + slot - start, entries, None,
                                 {"triangles": count, "boxes": scene["boxes"][first:first + count]}))
        entry += entries
    reject_if(slot != len(below) or entry != references, 3003, "nodes or entries of no BLAS")
    reject_if(max(depths) != stated_depth, 3009, "depth")
