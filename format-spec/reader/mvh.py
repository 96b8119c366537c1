"""The mvh form: mvh.md."""
import math
import struct

from boxes import box_within
from clauses import reject_if
from floats import MAX_FLOAT, binary32


def read_mvh(chunks, slots, references):
    raw = chunks.expect("FORM", 64)
    root, (zeta, of_both), (axes, size) = struct.unpack_from("<6f", raw), struct.unpack_from("<2f", raw, 24), struct.unpack_from("<2I", raw, 32)
    reject_if(any(raw[40:]), 2006, "FORM: reserved")
    reject_if(not all(map(math.isfinite, root)), 4001, "FORM: box")
    reject_if(not (0 < zeta <= binary32(0.99) and 0 < of_both <= 0.5 and 1 <= axes <= 3 and 1 <= size <= 16), 2019, "FORM")
    leaves = (references + size - 1) // size
    reject_if(slots != 2 * leaves, 2011, "slots")
    words = (leaves + 7) // 8
    nibbles = [byte >> shift & 15 for byte in chunks.expect("NODE", 4 * words) for shift in (0, 4)]
    reject_if(any(nibbles[leaves - 1:]), 2006, "NODE: spare nibbles")
    first_deepest = (1 << (leaves - 1).bit_length()) - 1
    boxes, nodes = {0: (list(root), 0)}, [None, (0,) * 8]
    for node in range(2 * leaves - 1):
        box, turn = boxes.pop(node)
        if node >= leaves - 1:
            number = node - first_deepest if node >= first_deepest else node - first_deepest + leaves
            entry = (*box, number * size, min(size, references - number * size))
        else:
            entry = (*box, 2 * node + 2, 0)
            sizes = [binary32(box[a + 3] - box[a]) for a in range(3)]
            axis = sorted(range(3), key=lambda a: -sizes[a])[turn]
            length = min(sizes[axis], MAX_FLOAT)
            for child in (0, 1):
                code, cut = nibbles[node] >> 2 * child & 3, list(box)
                part = binary32((of_both if code == 3 else zeta) * length)
                if code & 1:
                    cut[axis] = binary32(box[axis] + part)
                if code & 2:
                    cut[axis + 3] = binary32(box[axis + 3] - part)
                boxes[2 * node + 1 + child] = (cut, (turn + 1) % axes if code == 0 else 0)
        if node == 0:
            nodes[0] = entry
        else:
            nodes.append(entry)
    return nodes, chunks.expect("PRIM", 4 * references)


def mvh_node(box, root, own, run, size, codes, frame, used, below, base):
    """The node with a box over a run of entries, its insets in `frame` being `own`, in the tree whose root has the box `root`. What lies below is
    put into `below`."""
    first, count = run
    if count <= size:
        return (*box, first, count)
    leaves = -(-count // size)
    left = size * -(-leaves // 2)
    at, pair = (first + left) // size, len(below)
    used.add(at)
    below += [None, None]
    for child, (code, entries) in enumerate(((codes[at] & 15, (first, left)), (codes[at] >> 4, (first + left, count - left)))):
        inner = list(own)
        if code:
            axis, kind = divmod(code - 1, 5)
            extent = ((frame[axis + 3] - frame[axis]) - own[axis]) - own[axis + 3]
            inner[axis] += (7 / 16, 1 / 4, 0, 0, 1 / 4)[kind] * extent
            inner[axis + 3] += (0, 0, 7 / 16, 1 / 4, 1 / 4)[kind] * extent
        below[pair + child] = mvh_node(box_within(root, frame, inner), root, inner, entries, size, codes, frame, used, below, base)
    return (*box, pair + base, 0)
