"""The ssh form: ssh.md."""
import math
import struct

from clauses import reject_if


def read_ssh(chunks, slots, references):
    reject_if(references > 2**25, 2011, "references")
    raw = chunks.expect("FORM", 64)
    reject_if(any(raw[24:]), 2006, "FORM: reserved")
    records = list(struct.iter_unpack("<fI", chunks.expect("NODE", 8 * slots)))
    reject_if(records[1] != (0, 0) or math.copysign(1, records[1][0]) < 0, 3001, "slot 1")
    inherited, nodes = {0: struct.unpack_from("<6f", raw)}, []
    for index, (plane, word) in enumerate(records):
        if index == 1:
            nodes.append((0,) * 8)
            continue
        side, kind, rest = word & 7, word >> 3 & 3, word >> 5
        reject_if(side > 5, 3010, f"node {index}")
        if kind != 3:
            reject_if(2 * rest <= index or 2 * rest >= slots, 3002, f"node {index}")
        reject_if(index not in inherited, 3003, f"node {index}")
        box = list(inherited[index])
        reject_if(math.isfinite(plane) and (plane < box[side] if side < 3 else plane > box[side]), 4002, f"node {index}")
        box[side] = plane
        if kind == 3:
            nodes.append((*box, rest & (2**25 - 1), (rest >> 25) + 1))
        else:
            inherited[2 * rest] = inherited[2 * rest + 1] = box
            nodes.append((*box, 2 * rest, 0))
    return nodes, chunks.expect("PRIM", 4 * references)


def ssh_node(index, plane, word, box, slots, base, inherited):
    """The same for an ssh node (index -1: a root), which leaves its box with its children."""
    side, kind, rest = word & 7, word >> 3 & 3, word >> 5
    reject_if(side > 5 or (index < 0 and side != 0), 3010, f"node {index} of a level")
    if plane is not None:
        reject_if(math.isfinite(plane) and (plane < box[side] if side < 3 else plane > box[side]), 4002, f"node {index}")
        box = (*box[:side], plane, *box[side + 1:])
    if kind == 3:
        return (*box, rest & (2**25 - 1), (rest >> 25) + 1)
    reject_if(not index < 2 * rest < slots, 3002, f"node {index} of a level")
    inherited[2 * rest] = inherited[2 * rest + 1] = box
    return (*box, 2 * rest + base, 0)
