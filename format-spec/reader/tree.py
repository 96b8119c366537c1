"""What every tree must be, whatever its form: chunks.md."""
import math
import struct

from boxes import inside
from clauses import reject_if


def check_tree(nodes, raw_primitives, slots, references, stated_depth, scene):
    """Checks the tree, and returns its depth."""
    primitives = struct.unpack(f"<{references}I", raw_primitives)
    triangles, boxes = scene["triangles"], scene["boxes"]
    for index, node in enumerate(nodes):
        bad = not all(map(math.isfinite, node[:6])) or any(node[i] > node[i + 3] for i in range(3))
        reject_if(bad and index != 1, 4001, f"node {index}")
    depth, owner, leaf_boxes = {0: 0}, [False] * references, {}
    for index, node in enumerate(nodes):
        if index == 1:
            continue
        box, first, count = node[:6], node[6], node[7]
        if count > 0:
            reject_if(count > 65535 or first + count > references, 3004, f"leaf {index}")
            for entry in range(first, first + count):
                reject_if(owner[entry], 3005, f"entry {entry}")
                owner[entry] = True
                reject_if(primitives[entry] >= triangles, 3006, f"entry {entry}")
                leaf_boxes.setdefault(primitives[entry], []).append(box)
            continue
        reject_if(first % 2 or first <= index or first >= slots, 3002, f"node {index}")
        reject_if(first in depth, 3003, f"node {first}")
        reject_if(index not in depth, 3003, f"node {index}")  # parents come first, so its parent would be known by now
        for child in (first, first + 1):
            depth[child] = depth[index] + 1
            reject_if(not inside(nodes[child], box), 4002, f"node {child}")
    reject_if(len(depth) != slots - 1, 3003, "a node has no parent")
    reject_if(not all(owner), 3005, "gap")
    reject_if(len(leaf_boxes) != triangles, 3007, "a triangle is in no leaf")
    reject_if(max(depth.values()) > 96, 3008, "too deep")
    reject_if(stated_depth is not None and max(depth.values()) != stated_depth, 3009, "depth")
    if boxes is None:
        return None
    for triangle, leaves in leaf_boxes.items():
        t = boxes[triangle]
        if references == triangles:
            reject_if(not inside(t, leaves[0]), 4003, f"triangle {triangle}")
        else:
            hull = [min(b[i] for b in leaves) for i in range(3)] + [max(b[i] for b in leaves) for i in range(3, 6)]
            reject_if(not inside(t, hull), 4003, f"triangle {triangle}")
            for b in leaves:
                reject_if(any(t[i] > b[i + 3] or t[i + 3] < b[i] for i in range(3)), 4003, f"triangle {triangle}")
    return max(depth.values())
