"""The aabb form: aabb.md."""
import struct

from clauses import reject_if


def read_aabb(chunks, slots, references):
    """The form's nodes as tuples (box of six numbers, first, count), and the leaf order."""
    raw = chunks.expect("NODE", 32 * slots)
    reject_if(any(raw[32:64]), 3001, "slot 1")
    return list(struct.iter_unpack("<6f2I", raw)), chunks.expect("PRIM", 4 * references)


def join_aabb(node, index, slots, base):
    """A node of a level as one of the whole tree, where the level's slots start at `base`."""
    first, count = node[6:]
    reject_if(count == 0 and not index < first < slots, 3002, f"node {index} of a level")
    return (*node[:6], first + base, 0) if count == 0 else node
