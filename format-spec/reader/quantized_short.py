"""The quantized-short form: quantized-short.md."""
import struct

from boxes import box_of, check_root
from clauses import reject_if
from clusters import LINES


def read_quantized_short(chunks, slots, references):
    reject_if(references > 2**27 or (slots == 2 and references > 32), 2011, "references")
    raw = chunks.expect("FORM", 64)
    reject_if(any(raw[40:]), 2006, "FORM: reserved")
    *root, bits, line_slots, count = struct.unpack_from("<6f2IQ", raw)
    check_root(root)
    reject_if(not 2 <= bits <= 10 or line_slots not in LINES or count >= 2**32, 2019, "FORM")
    words = list(struct.iter_unpack("<2I", chunks.expect("NODE", 8 * count)))
    marks = None
    if references != slots // 2:
        raw = chunks.expect("LAST", 4 * ((references + 31) // 32 + 1))
        marks = [raw[i // 8] >> i % 8 & 1 for i in range(8 * len(raw))]
        reject_if(any(marks[references:]), 2006, "LAST: a bit of no entry")
    primitives = chunks.expect("PRIM", 4 * references)

    def leaf_size(first):
        size = 1 if marks is None else next((k for k in range(1, 33) if first + k <= references and marks[first + k - 1]), 0)
        reject_if(first >= references or size == 0, 3004, f"a leaf from entry {first} on")
        return size

    pair_of = {}
    for slot, (low, _) in enumerate(words):
        if low >= 2**21:
            pair_of[slot] = len(pair_of)
    extent = [root[i + 3] - root[i] for i in range(3)]
    nodes = [(*root, 2, 0) if count else (*root, 0, references), (0,) * 8]
    reached, started = {0: (0, 0, (0.0,) * 6)}, 0  # cluster's first slot, its first entry, insets
    reject_if(count > 0 and 0 not in pair_of, 3002, "slot 0")
    for slot, (low, high) in enumerate(words):
        if slot not in reached:
            reject_if(low or high, 3003, f"slot {slot}")
            continue
        first, entry, parent = reached[slot]
        if first == slot:
            started = slot
        reject_if(first != started, 3011, f"slot {slot}")
        if low < 2**21:
            target = (low | high >> 27 << 21) * line_slots
            reject_if(not slot < target < count or target not in pair_of, 3002, f"slot {slot}")
            reject_if(target in reached, 3003, f"slot {target}")
            reached[target] = (target, high & (2**27 - 1), parent)
            continue
        planes = [word >> 6 * i & 63 for word in (low, high) for i in range(3)]
        steps = [((extent[i] - parent[i]) - parent[i + 3]) * 2.0**-6 for i in range(3)]
        for child, word in enumerate((low, high)):
            own = [parent[i] + planes[i] * steps[i % 3] if (low, high)[i // 3] >> (18 + i % 3) & 1 == child else parent[i] for i in range(6)]
            box, reference = box_of(root, own), word >> 21
            if reference >= 2**bits:
                leaf = entry + reference - 2**bits
                nodes.append((*box, leaf, leaf_size(leaf)))
                continue
            target = first + reference
            reject_if(not slot < target < count or words[target] == (0, 0), 3002, f"slot {slot}")
            reject_if(target in reached, 3003, f"slot {target}")
            reached[target] = (first, entry, own)
            if target not in pair_of:
                target = (words[target][0] | words[target][1] >> 27 << 21) * line_slots
            nodes.append((*box, 2 * pair_of.get(target, 0) + 2, 0))
    reject_if(2 * len(pair_of) + 2 != slots, 2011, "records")
    if count == 0:
        reject_if(leaf_size(0) != references, 3004, "the root")
    return nodes, primitives
