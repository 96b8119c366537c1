"""The quantized form: quantized.md."""
import struct

from boxes import box_within, check_root
from clauses import reject_if


def quantized_trees(raw, roots, places, bits, base):
    """The roots of trees whose records share one array, the nodes below them, and the insets of these."""
    count, parents, below, insets = len(raw) // 16, {}, [], []

    def named(index, word, more, box, own, place):
        if word >> 31:
            return (*box, word & (2**29 - 1), (more >> 3 << 2 | word >> 29 & 3) + 1)
        reject_if(more >> 3, 3010, f"record {index}")
        reject_if(not index < word < count, 3002, f"record {index}")
        reject_if(word in parents, 3003, f"record {word}")
        parents[word] = own, place
        return (*box, 2 * word + base, 0)

    whole = [named(-1, *roots[place[3][0]], place[0], place[2], place) for place in places]
    for index, record in enumerate(struct.iter_unpack("<8B2I", raw)):
        planes, owners, words = record[:3] + record[4:7], (record[3], record[7]), record[8:]
        reject_if(any(n >> bits for n in planes), 3010, f"record {index}")
        reject_if(index not in parents, 3003, f"record {index}")
        parent, place = parents[index]
        root, frame = place[:2]
        steps = [(((frame[i + 3] - frame[i]) - parent[i]) - parent[i + 3]) * 2.0**-bits for i in range(3)]
        for child, word in enumerate(words):
            own = [parent[i] + planes[i] * steps[i % 3] if owners[i // 3] >> i % 3 & 1 == child else parent[i] for i in range(6)]
            insets.append(own)
            below.append(named(index, word, owners[child], box_within(root, frame, own), own, place))
    return whole, below, insets


def quantized_nodes(raw, root, bits, leaf_size):
    """The nodes of one tree, and the insets of leaves by node. A root that is a leaf has leaf_size entries."""
    if not raw:
        return [(*root, 0, leaf_size), (0,) * 8], {0: (0.0,) * 6}
    whole, below, insets = quantized_trees(raw, [(0, 0)], [(root, root, (0.0,) * 6, (0, 1))], bits, 2)
    return whole + [(0,) * 8] + below, {2 + i: own for i, own in enumerate(insets) if below[i][7]}


def read_quantized(chunks, slots, references):
    count = slots // 2 - 1
    reject_if(references > 2**29 or (count == 0 and references > 128), 2011, "references")
    raw = chunks.expect("FORM", 64)
    reject_if(any(raw[28:]), 2006, "FORM: reserved")
    *root, bits = struct.unpack_from("<6fI", raw)
    check_root(root)
    reject_if(not 5 <= bits <= 8, 2019, "bits")
    return quantized_nodes(chunks.expect("NODE", 16 * count), root, bits, references)[0], chunks.expect("PRIM", 4 * references)
