"""The aabb form stored without boxes: topology.md."""
import struct

from clauses import reject_if


def read_topology(chunks, slots, references, boxes):
    """The aabb form's nodes out of PRIM and TOPO; `boxes` are the triangles', or None when nobody knows them: then nodes' are zero."""
    raw_primitives = chunks.expect("PRIM", 4 * references)
    primitives = struct.unpack(f"<{references}I", raw_primitives)
    if boxes is not None:
        reject_if(any(p >= len(boxes) for p in primitives), 3006, "PRIM")
    raw, pairs, bitmap = chunks.expect("TOPO"), slots // 2, (slots + 7) // 8
    reject_if(len(raw) < 64, 2005, "TOPO: header")
    order, ranges, size_bytes, reserved, box_count, plane_count = struct.unpack_from("<4I2Q", raw)
    reject_if(reserved != 0 or any(raw[32:64]), 2006, "TOPO: reserved")
    reject_if(order > 1 or ranges > 1 or size_bytes > 2 or box_count >= slots or plane_count > 6 * box_count, 2016, "TOPO: header")
    sizes = [bitmap, order * 4 * (pairs - 1), ranges * 4 * pairs, size_bytes * pairs, bitmap if box_count else 0, box_count,
             4 * plane_count]
    reject_if(len(raw) != 64 + sum(sizes), 2005, "TOPO: size")
    streams, at = [], 64
    for size in sizes:
        streams.append(raw[at:at + size])
        at += size

    def bits(stream):
        values = [stream[i // 8] >> i % 8 & 1 for i in range(8 * len(stream))]
        reject_if(values[1] or any(values[slots:]), 2006, "TOPO: reserved bit")
        return values

    def numbers(stream, count):
        return [sum(stream[plane * count + i] << 8 * plane for plane in range(len(stream) // count)) for i in range(count)]

    inner = bits(streams[0])
    reject_if(sum(inner) != pairs - 1, 2016, "TOPO: inner nodes")
    firsts, depths, waiting = [0] * slots, [0] * slots, [0] if inner[0] else []
    distances = numbers(streams[1], pairs - 1) if order else []
    for left in range(2, slots, 2):
        if order:
            parent = left - distances[left // 2 - 1]
            reject_if(not 0 <= parent < left or not inner[parent] or firsts[parent], 2016, f"TOPO: parent of {left}")
        else:
            reject_if(not waiting, 2016, f"TOPO: parent of {left}")
            parent = waiting.pop()
            waiting += [child for child in (left + 1, left) if inner[child]]
        firsts[parent] = left
        depths[left] = depths[left + 1] = depths[parent] + 1
        reject_if(depths[left] > 96, 3008, f"node {left}")
    leaves = [i for i in range(slots) if i != 1 and not inner[i]]
    leaf_sizes = numbers(streams[3], pairs) if size_bytes else [0] * pairs
    counts = [0] * slots
    for leaf, size in zip(leaves, leaf_sizes):
        reject_if(size > 65534, 3004, f"leaf {leaf}")
        counts[leaf] = size + 1
    reject_if(sum(counts) != references, 3005, "sizes of leaves")
    next_first, stack = 0, [0]
    while stack:
        node = stack.pop()
        if inner[node]:
            stack += [firsts[node] + 1, firsts[node]]
        else:
            firsts[node] = next_first
            next_first += counts[node]
    if ranges:
        for leaf, number in zip(leaves, numbers(streams[2], pairs)):
            firsts[leaf] = (firsts[leaf] + (-(number >> 1) - 1 if number & 1 else number >> 1)) % 2**32
    for leaf in leaves:
        reject_if(firsts[leaf] + counts[leaf] > references, 3004, f"leaf {leaf}")

    fitted = [(0,) * 6] * slots
    if boxes is not None:
        boxed = bits(streams[4]) if box_count else [0] * slots
        reject_if(sum(boxed) != box_count, 2016, "TOPO: stored boxes")
        reject_if(any(not 0 < s < 64 for s in streams[5]), 2016, "TOPO: sides")
        reject_if(sum(bin(s).count("1") for s in streams[5]) != plane_count, 2016, "TOPO: planes")
        values, stored = iter(struct.unpack(f"<{plane_count}f", streams[6])), {}
        nodes_with_boxes = [i for i in range(slots) if boxed[i]]
        for side in range(6):
            for node, sides in zip(nodes_with_boxes, streams[5]):
                if sides >> side & 1:
                    stored[node, side] = next(values)
        for node in reversed(range(slots)):
            if node == 1:
                continue
            if inner[node]:
                parts = [fitted[firsts[node]], fitted[firsts[node] + 1]]
            else:
                parts = [boxes[p] for p in primitives[firsts[node]:firsts[node] + counts[node]]]
            box = [(min if side < 3 else max)(part[side] for part in parts) for side in range(6)]
            fitted[node] = tuple(stored.get((node, side), box[side]) for side in range(6))
    return [(*box, first, count) for box, first, count in zip(fitted, firsts, counts)], raw_primitives
