#!/usr/bin/python3
"""A second reader of .bvhx files, written from the pages of format-spec alone; it shares no code with the library.

Usage: bvhx_reader.py FILE...        "-" is standard input
Prints a summary of each file, or the clause by which it must be rejected. Exit: 0 all read, 2 a file cannot be opened,
3 a file is invalid, 5 a file is unsupported (of the last file that was not read). Draco geometry is not decoded: the checks
that need its vertices are left out, and the summary says so.

Needs the Python modules xxhash and zstandard (Debian: python3-xxhash, python3-zstandard).
"""
import math
import struct
import sys

import xxhash
import zstandard

SIGNATURE = bytes.fromhex("9C 42 56 48 58 20 0D 0A 1A 0A 00 FE")
VERSION = (1, 0)
BLOCK = 1 << 20
MAX_SIZE = 1 << 48
MAX_EXPANSION = 32
MAX_FLOAT = struct.unpack("<f", b"\xFF\xFF\x7F\x7F")[0]
UNSUPPORTED = {1003, 1004, 1014, 2001, 2008, 2010}
CRITICAL = 1
LINES = (1, 2, 4, 8, 16, 32, 64)

# Known types in file order: flags.
KNOWN = {"SCEN": 7, "VERT": 7, "TRIS": 7, "DRCO": 7, "GEOM": 7, "SRCP": 7, "MESH": 7, "INST": 7, "TREE": 1, "ENTR": 1, "FORM": 1, "NODE": 1, "TLAS": 1, "ROOT": 1, "BLAS": 1, "LAST": 1,
         "PRIM": 1, "TOPO": 1, "CLUS": 0, "VISI": 0, "PROV": 6}


class Rejected(Exception):
    def __init__(self, clause, message):
        super().__init__(message)
        self.clause = clause
        self.kind = "unsupported" if clause in UNSUPPORTED else "invalid"


def reject_if(condition, clause, message):
    if condition:
        raise Rejected(clause, message)


def hash64(data):
    return xxhash.xxh3_64_intdigest(data)


def digest(data):
    hashes = [struct.pack("<Q", hash64(data[i:i + BLOCK])) for i in range(0, len(data), BLOCK)]
    return hash64(b"".join(hashes))


def decode_zstd(stored, raw_size):
    """The blocks of container.md 6, one frame each."""
    raw = bytearray()
    try:
        while len(raw) < raw_size:
            reject_if(stored[:4] != b"\x28\xB5\x2F\xFD", 1018, "no zstd frame")
            parameters = zstandard.get_frame_parameters(stored)
            expected = min(BLOCK, raw_size - len(raw))
            reject_if(parameters.content_size != expected or parameters.dict_id != 0, 1018, "not a frame of one block")
            decoder = zstandard.ZstdDecompressor().decompressobj()
            block = decoder.decompress(stored)
            reject_if(len(block) != expected, 1018, "a frame has the wrong size")
            raw += block
            stored = decoder.unused_data
    except zstandard.ZstdError as error:
        raise Rejected(1018, str(error)) from error
    reject_if(len(stored) > 0, 1018, "bytes follow the last frame")
    return bytes(raw)


def decode_numbers(stored, raw_size, stride):
    """Codecs 2 and 3 of container.md 6."""
    reject_if(raw_size % 4 != 0, 1018, "no whole count of numbers")
    planes, raw = decode_zstd(stored, raw_size), bytearray()
    for at in range(0, raw_size, BLOCK):
        block, numbers = planes[at:at + BLOCK], [0] * stride
        count = len(block) // 4
        for i in range(count):
            folded = sum(block[plane * count + i] << 8 * plane for plane in range(4))
            numbers.append((numbers[-stride] + (-(folded >> 1) - 1 if folded & 1 else folded >> 1)) % 2**32)
        raw += struct.pack(f"<{count}I", *numbers[stride:])
    return bytes(raw)


class Chunk:
    def __init__(self, kind, flags, codec, raw_size, stored_size, offset, raw):
        self.type, self.flags, self.codec, self.offset, self.raw = kind, flags, codec, offset, raw
        self.raw_size, self.stored_size = raw_size, stored_size


def read_header(data):
    reject_if(data[:12] != SIGNATURE[:len(data)], 1001, "no signature")
    reject_if(len(data) < 64, 1010, "cut within the header")
    major, minor, reader_major, reader_minor = struct.unpack_from("<4H", data, 12)
    reject_if(struct.unpack_from("<Q", data, 56)[0] != hash64(data[:56]), 1002, "header checksum")
    reject_if(major > VERSION[0], 1003, f"version {major}.{minor}")
    reject_if(major == 0 or (reader_major, reader_minor) > (major, minor), 1005, "versions out of order")
    reject_if((reader_major, reader_minor) > VERSION, 1004, f"needs a reader of version {reader_major}.{reader_minor}")
    reject_if(any(data[20:56]), 1006, "reserved bytes")
    return f"{major}.{minor}"


def read_container(data):
    """All chunks but END; checks every clause R10xx."""
    read_header(data)
    chunks, records, offset = [], [], 64
    while True:
        header = data[offset:offset + 64]
        reject_if(len(header) < 64, 1010, f"cut at {offset}")
        type_bytes, flags, codec, reserved = struct.unpack_from("<4s3I", header)
        raw_size, stored_size, checksum = struct.unpack_from("<3Q", header, 16)
        reject_if(struct.unpack_from("<Q", header, 56)[0] != hash64(header[:56]), 1011, f"chunk header at {offset}")
        reject_if(any(not (bytes([b]).isalnum() or b == 32) for b in type_bytes), 1013, f"type {type_bytes}")
        kind = type_bytes.decode("ascii")
        reject_if(reserved != 0 or any(header[40:56]) or flags >= 8, 1012, f"{kind}: reserved field or flag")
        reject_if(codec > 3, 1014, f"{kind}: codec {codec}")
        reject_if(raw_size > MAX_SIZE or stored_size > MAX_SIZE, 1015, f"{kind}: too large")
        reject_if(codec == 0 and raw_size != stored_size, 1015, f"{kind}: two sizes")
        reject_if(codec > 0 and not 1 <= raw_size <= MAX_EXPANSION * stored_size, 1015, f"{kind}: expands too much")
        end = offset + 64 + stored_size
        padded = (end + 63) // 64 * 64
        stored = data[offset + 64:end]
        reject_if(len(data) < padded, 1010, f"{kind}: cut")
        reject_if(any(data[end:padded]), 1017, f"{kind}: padding")
        reject_if(digest(stored) != checksum, 1016, f"{kind}: payload checksum")
        if codec == 0:
            raw = stored
        elif codec == 1:
            raw = decode_zstd(stored, raw_size)
        else:
            raw = decode_numbers(stored, raw_size, 1 if codec == 2 else 3)
        offset = padded
        if kind == "END ":
            break
        chunks.append(Chunk(kind, flags, codec, raw_size, stored_size, offset, raw))
        if kind != "PROV":
            records.append(struct.pack("<4sIQQ", type_bytes, flags, raw_size, digest(raw)))
    reject_if(flags != CRITICAL or codec != 0 or raw_size != 32, 1020, "END's header")
    content_hash, count, size, reserved = struct.unpack("<4Q", raw)
    reject_if(reserved != 0, 1020, "END's reserved field")
    reject_if(count != len(chunks) or size != offset, 1021, "END's totals")
    reject_if(content_hash != hash64(b"".join(records)), 1022, "content hash")
    reject_if(len(data) > offset, 1023, "bytes after END")
    return chunks, content_hash


class Sequence:
    """Known chunks in the order of chunks.md."""

    def __init__(self, chunks):
        self.known, seen = [], set()
        for chunk in chunks:
            if chunk.type not in KNOWN:
                reject_if(chunk.flags & CRITICAL, 2001, f"unknown critical chunk {chunk.type}")
                continue
            reject_if(chunk.flags != KNOWN[chunk.type], 2004, f"flags of {chunk.type}")
            reject_if(chunk.type in seen, 2003, f"{chunk.type} twice")
            seen.add(chunk.type)
            self.known.append(chunk)

    def expect(self, kind, size=None):
        found = self.known.pop(0) if self.known else None
        reject_if(found is None or found.type != kind, 2002, f"{kind} should be here")
        reject_if(size is not None and found.raw_size != size, 2005, f"size of {kind}")
        return found.raw

    def next_is(self, kind):
        return bool(self.known) and self.known[0].type == kind


def check_text(data):
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise Rejected(2014, "text is not UTF-8") from error


def read_scene(chunks):
    raw = chunks.expect("SCEN", 64)
    vertices, triangles, geometries, name_bytes, encoding, flags, meshes, instances = struct.unpack_from("<4Q4I", raw)
    reject_if(any(raw[48:]) or flags > 3 or (flags < 2 and meshes + instances > 0), 2006, "SCEN: reserved")
    reject_if(not (1 <= vertices < 2**32 and 1 <= triangles < 2**31 and 1 <= geometries < 2**32 and name_bytes < 2**32), 2007,
              "SCEN: counts")
    if flags & 2:
        reject_if(not (1 <= meshes <= geometries and 1 <= instances < 2**31), 2007, "SCEN: counts of instances")
        reject_if(encoding == 1, 2020, "instances with Draco")
    reject_if(encoding > 1, 2008, "geometry encoding")
    points, corners = None, None
    if encoding == 0:
        points = list(struct.iter_unpack("<3f", chunks.expect("VERT", 12 * vertices)))
        for p in points:
            reject_if(not all(map(math.isfinite, p)), 4004, "vertex")
            reject_if(any(c == 0 and math.copysign(1, c) < 0 for c in p), 4005, "-0")
        corners = list(struct.iter_unpack("<3I", chunks.expect("TRIS", 12 * triangles)))
        reject_if(any(i >= vertices for t in corners for i in t), 4006, "vertex index")
    else:
        chunks.expect("DRCO")
    raw = chunks.expect("GEOM", 8 * geometries + name_bytes)
    table = list(struct.iter_unpack("<2I", raw[:8 * geometries]))
    reject_if(sum(c for c, _ in table) != triangles or sum(n for _, n in table) != name_bytes, 2009, "geometry table")
    names, at = [], 8 * geometries
    for _, length in table:
        names.append(check_text(raw[at:at + length]))
        at += length
    if flags & 1:
        chunks.expect("SRCP", 4 * triangles)
    boxes = None
    if points is not None:
        boxes = [[f(points[i][axis] for i in t) for f in (min, max) for axis in range(3)] for t in corners]
    scene = {"vertices": vertices, "triangles": triangles, "geometries": len(names), "boxes": boxes}
    if flags & 2:
        read_instances(chunks, scene, [count for count, _ in table], meshes, instances)
    return scene


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


def around(boxes):
    return [(min if i < 3 else max)(b[i] for b in boxes) for i in range(6)]


LARGEST = struct.unpack("<f", bytes.fromhex("FFFF7F7F"))[0]


def round_down(value):
    """The largest binary32 that is not above `value`, as instances.md 3 has it."""
    if abs(value) >= LARGEST:
        return math.copysign(LARGEST, value)
    rounded = struct.unpack("<f", struct.pack("<f", value))[0]
    if rounded > value:
        bits, = struct.unpack("<i", struct.pack("<f", rounded))
        bits = bits - 1 if bits > 0 else -2**31 + 1 if bits in (0, -2**31) else bits + 1
        rounded, = struct.unpack("<f", struct.pack("<i", bits))
    return rounded + 0.0


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


def inside(inner, outer):
    return all(outer[i] <= inner[i] and outer[i + 3] >= inner[i + 3] for i in range(3))


def read_aabb(chunks, slots, references):
    """The form's nodes as tuples (box of six numbers, first, count), and the leaf order."""
    raw = chunks.expect("NODE", 32 * slots)
    reject_if(any(raw[32:64]), 3001, "slot 1")
    return list(struct.iter_unpack("<6f2I", raw)), chunks.expect("PRIM", 4 * references)


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


def join_aabb(node, index, slots, base):
    """A node of a level as one of the whole tree, where the level's slots start at `base`."""
    first, count = node[6:]
    reject_if(count == 0 and not index < first < slots, 3002, f"node {index} of a level")
    return (*node[:6], first + base, 0) if count == 0 else node


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


def insets_of(root, box):
    own = [box[i] - root[i] if i < 3 else root[i] - box[i] for i in range(6)]
    for i in range(6):
        while (root[i] + own[i] > box[i]) if i < 3 else (root[i] - own[i] < box[i]):
            own[i] = math.nextafter(own[i], -math.inf)
    return own


def read_levels(chunks, slots, references, scene):
    """The top level's nodes, the roots of BLASes as nodes (those of its leaves, or, with instances, of the meshes), the nodes below
    them, PRIM, and ENTR."""
    raw = chunks.expect("FORM", 64)
    tlas_form, blas_form, blas_size, leaf_size, tlas_slots, blases, *root = struct.unpack_from("<4s4s2I2Q6f", raw)
    quantized, runs = tlas_form == b"quan", blas_form == b"mvh "
    has_bits = b"quan" in (tlas_form, blas_form)
    bits, = struct.unpack_from("<I", raw, 56)
    reject_if((leaf_size != 0 and not runs) or any(raw[60:]) or (not has_bits and bits) or (not quantized and any(raw[32:56])), 2006, "FORM: reserved")
    reject_if(not (2 <= tlas_slots <= slots and tlas_slots % 2 == 0 and blases == tlas_slots // 2
                   and ("placed" in scene or blases <= references) and 1 <= blas_size <= 65535), 2011, "FORM: counts")
    reject_if(tlas_form not in (b"aabb", b"quan") or blas_form not in (b"aabb", b"ssh ", b"mvh ", b"quan"), 2010, "form of a level")
    reject_if(blas_form == b"ssh " and references > 2**25, 2011, "references")
    reject_if((has_bits or runs) and references > 2**29, 2011, "references")
    reject_if(has_bits and not 5 <= bits <= 8, 2019, "bits")
    reject_if(runs and not 1 <= leaf_size <= 16, 2019, "leafSize")
    slots -= tlas_slots
    base, trees, entries = tlas_slots, blases, None
    if "placed" in scene:
        base, trees = 0, len(scene["runs"])
        reject_if(blases != len(scene["placed"]), 2020, "leaves of the top level")
        reject_if(runs and references != scene["triangles"], 2011, "references")
        entries = chunks.expect("ENTR", 4 * blases)
        reject_if(any(e >= blases for e, in struct.iter_unpack("<I", entries)), 3006, "ENTR")
    top_has_runs = runs and entries is None
    if quantized:
        check_root(root)
        reject_if(tlas_slots == 2 and top_has_runs and references > 128, 2011, "a root that is a leaf")
        nodes, insets = quantized_nodes(chunks.expect("TLAS", 8 * tlas_slots - 16), root, bits, references if top_has_runs else blases)
    else:
        raw = chunks.expect("TLAS", 32 * tlas_slots)
        reject_if(any(raw[32:64]), 3001, "slot 1")
        nodes = list(struct.iter_unpack("<6f2I", raw))
    leaves = [i for i, node in enumerate(nodes) if node[7] != 0]
    for i in leaves:
        first, count = nodes[i][6:]
        reject_if(first + count > references if top_has_runs else count != 1 or first >= blases, 3004, f"leaf {i}")
    for i, node in enumerate(nodes):
        if i != 1 and node[7] == 0:
            join_aabb(node, i, tlas_slots, 0)
    # Where BLASes have their roots: the box, the one that insets are measured from, and the insets; and what names the BLAS.
    if entries is None:
        frame = nodes[0][:6]
        if not quantized:
            insets = {i: insets_of(frame, nodes[i][:6]) for i in leaves if all(map(math.isfinite, (*frame, *nodes[i][:6])))}
        places = [(nodes[i][:6], frame, insets.get(i, (0.0,) * 6), nodes[i][6:]) for i in leaves]
    elif runs:
        places = [(tuple(box), box, (0.0,) * 6, run) for box, run in zip(scene["mesh_boxes"], scene["runs"])]
    else:
        places = [(tuple(box), box, (0.0,) * 6, (k, 1)) for k, box in enumerate(scene["mesh_boxes"])]
    if runs:
        reject_if(sum(2 * (-(-count // leaf_size) - 1) for *_, (_, count) in places) != slots, 2011, "slots of the BLASes")
        codes, used, whole, below = chunks.expect("BLAS", -(-references // leaf_size)), set(), [], []
        for box, frame, own, run in places:
            whole.append(mvh_node(box, box, own, run, leaf_size, codes, frame, used, below, base))
        reject_if(any(code for at, code in enumerate(codes) if at not in used), 2006, "a byte that serves no node")
    elif blas_form == b"quan":
        roots = list(struct.iter_unpack("<2I", chunks.expect("ROOT", 8 * trees)))
        for word, more in roots:
            reject_if(more % 8 or more > (0xFF if word >> 31 else 0), 3010, "a root's more")
            reject_if(not word >> 31 and word >= slots // 2, 3002, "a root's record")
        whole, below, _ = quantized_trees(chunks.expect("BLAS", 8 * slots), roots, places, bits, base)
    elif blas_form == b"aabb":
        roots = list(struct.iter_unpack("<2I", chunks.expect("ROOT", 8 * trees)))
        below = [join_aabb(n, i, slots, base) for i, n in enumerate(struct.iter_unpack("<6f2I", chunks.expect("BLAS", 32 * slots)))]
        whole = [join_aabb((*box, *roots[k]), -1, slots, base) for box, *_, (k, _) in places]
    else:
        roots = struct.unpack(f"<{trees}I", chunks.expect("ROOT", 4 * trees))
        inherited, below = {}, []
        whole = [ssh_node(-1, None, roots[k], box, slots, base, inherited) for box, *_, (k, _) in places]
        for i, (plane, word) in enumerate(struct.iter_unpack("<fI", chunks.expect("BLAS", 8 * slots))):
            reject_if(i not in inherited, 3003, f"node {i} of the bottom level")
            below.append(ssh_node(i, plane, word, inherited[i], slots, base, inherited))
    return nodes, whole, below, chunks.expect("PRIM", 4 * references), entries


def read_two_level(chunks, slots, references):
    nodes, roots, below, primitives, _ = read_levels(chunks, slots, references, {})
    leaves = [i for i, node in enumerate(nodes) if node[7] != 0]
    for i, root in zip(leaves, roots):
        nodes[i] = root
    return nodes + below, primitives


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


def float_up(x):
    """The least binary32 number that is not below x."""
    nearest = struct.unpack("<f", struct.pack("<f", x))[0]
    if nearest >= x:
        return nearest
    bits = struct.unpack("<i", struct.pack("<f", nearest))[0]
    bits = 1 if nearest == 0 else bits + (1 if nearest > 0 else -1)
    return struct.unpack("<f", struct.pack("<i", bits))[0]


def check_root(root):
    reject_if(not all(map(math.isfinite, root)) or any(root[i] > root[i + 3] for i in range(3)), 4001, "the root's box")


def box_of(root, own):
    """The floats within the box that insets give."""
    return [float_up(root[i] + own[i]) for i in range(3)] + [-float_up(-(root[i] - own[i])) for i in range(3, 6)]


def box_within(root, frame, own):
    """What of that lies in the box of a tree's root."""
    box = box_of(frame, own)
    return [max(box[i], root[i]) if i < 3 else min(box[i], root[i]) for i in range(6)]


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


def check_clusters(nodes, raw):
    """CLUS beside a tree that is right."""
    reject_if(len(raw) < 20 or len(raw) % 4 != 0, 2005, "CLUS")
    bits, line_slots, *words = struct.unpack(f"<{len(raw) // 4}I", raw)
    reject_if(words.pop(0) != 0 or words.pop(0) != 0, 2006, "CLUS: reserved")
    reject_if(not 2 <= bits <= 10 or line_slots not in LINES, 3011, "CLUS: parameters")
    parents = {node[6] // 2 - 1: i // 2 - 1 for i, node in enumerate(nodes) if i != 1 and node[7] == 0}  # of the root's children: -1
    records, glue = {}, {}
    for slot, word in enumerate(words):
        if word != 2**32 - 1:
            found, pair = (glue if word >> 31 else records), word & (2**31 - 1)
            reject_if(pair not in parents or pair in found, 3011, f"slot {slot}")
            found[pair] = slot
    reject_if(len(records) != len(parents) or records.get(0) != 0 or 0 in glue, 3011, "CLUS: pairs")
    cluster_of, cluster = [], 0
    for slot, word in enumerate(words):
        if word in records and (word in glue or word == 0):
            cluster = slot
            reject_if(slot % line_slots != 0, 3011, f"slot {slot}")
        reject_if(word != 2**32 - 1 and slot - cluster >= 2**bits, 3011, f"slot {slot}")
        cluster_of.append(cluster)
    for pair, parent in parents.items():
        if parent >= 0:
            named = glue.get(pair, records[pair])
            reject_if(cluster_of[named] != cluster_of[records[parent]] or not records[parent] < named <= records[pair], 3011, f"pair {pair}")


def binary32(x):
    """Of a sum or product of two binary32 numbers in binary64: rounding twice gives what rounding once does."""
    try:
        return struct.unpack("<f", struct.pack("<f", x))[0]
    except OverflowError:
        return math.copysign(math.inf, x)


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


FORMS = {b"aabb": read_aabb, b"quan": read_quantized, b"qush": read_quantized_short, b"ssh ": read_ssh, b"mvh ": read_mvh, b"two ": read_two_level}


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


def read_tree(chunks, scene):
    raw = chunks.expect("TREE", 64)
    form, reserved, slots, references, traversal, intersection, depth = struct.unpack_from("<4sIQQ2fI", raw)
    reject_if(reserved != 0 or any(raw[36:]), 2006, "TREE: reserved")
    reject_if(form not in FORMS, 2010, f"form {form}")
    reject_if(not (scene["triangles"] <= references < 2**32 and 2 <= slots <= 2 * (references + len(scene.get("placed", ()))) and slots < 2**32
                   and slots % 2 == 0 and depth <= 96), 2011, "TREE: counts")
    for cost in (traversal, intersection):
        reject_if(not math.isfinite(cost) or math.copysign(1, cost) < 0, 2012, "SAH cost")
    reject_if(form == b"mvh " and references != scene["triangles"], 2011, "TREE: references")
    summary = {"form": form.decode().strip(), "nodes": slots - 1, "references": references, "depth": depth}
    if "placed" in scene:
        reject_if(form != b"two ", 2020, "form of an instanced scene")
        check_instanced(chunks, slots, references, depth, scene)
        return summary
    if form == b"aabb" and chunks.next_is("PRIM"):
        nodes, primitives = read_topology(chunks, slots, references, scene["boxes"])
    else:
        nodes, primitives = FORMS[form](chunks, slots, references)
    check_tree(nodes, primitives, slots, references, depth, scene)
    if form == b"aabb" and chunks.next_is("CLUS"):
        check_clusters(nodes, chunks.expect("CLUS"))
    if form == b"aabb" and chunks.next_is("VISI"):
        summary["rays"] = check_visits(struct.unpack(f"<{slots // 2}I", chunks.expect("VISI", 2 * slots)), nodes)
    return summary


def check_visits(visits, nodes):
    """Returns how many rays there were."""
    for index, node in enumerate(nodes):
        first, count = node[6:8]
        reject_if(index != 1 and count == 0 and visits[first // 2] > visits[index // 2], 2021, f"visits of pair {first}")
    return visits[0]


def read_provenance(raw):
    at, texts = 8, []
    reject_if(len(raw) < 8, 2013, "PROV: cut")
    count, reserved = struct.unpack_from("<2I", raw)
    reject_if(reserved != 0, 2006, "PROV: reserved")
    reject_if(12 * count > len(raw) - 8, 2013, "PROV: entries")
    for _ in range(3 * count):
        reject_if(at + 4 > len(raw), 2013, "PROV: cut")
        length, = struct.unpack_from("<I", raw, at)
        reject_if(at + 4 + length > len(raw), 2013, "PROV: cut")
        texts.append(check_text(raw[at + 4:at + 4 + length]))
        at += 4 + length
    reject_if(at != len(raw), 2013, "PROV: bytes behind the last entry")
    return texts[::3]


def read(data):
    """The summary of a file as a dict; raises Rejected."""
    all_chunks, content_hash = read_container(data)
    chunks = Sequence(all_chunks)
    scene = read_scene(chunks)
    tree = read_tree(chunks, scene)
    tools = read_provenance(chunks.expect("PROV")) if chunks.next_is("PROV") else []
    reject_if(bool(chunks.known), 2002, "END should be here")
    geometry = "not decoded" if scene.pop("boxes") is None else "checked"
    if "placed" in scene:
        scene["meshes"], scene["instances"] = len(scene.pop("runs")), len(scene.pop("placed"))
        del scene["mesh_boxes"]
    return {**scene, **tree, "geometry": geometry, "tools": " ".join(tools), "chunks": len(all_chunks),
            "content_hash": f"{content_hash:016x}"}


def main(paths):
    if not paths or paths[0] in ("-h", "--help"):
        print(__doc__)
        return 0 if paths else 1
    status = 0
    for path in paths:
        try:
            with (sys.stdin.buffer if path == "-" else open(path, "rb")) as file:
                data = file.read()
        except OSError as error:
            print(f"{path}: {error.strerror}")
            status = 2
            continue
        try:
            print(f"{path}: valid 0 " + " ".join(f"{k}={v}" for k, v in read(data).items()))
        except Rejected as rejected:
            print(f"{path}: {rejected.kind} {rejected.clause} {rejected}")
            status = 5 if rejected.kind == "unsupported" else 3
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
