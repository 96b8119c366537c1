#!/usr/bin/python3
"""Writes the malformed files of this folder, one or more for each clause by which a reader must reject a file, and manifest.csv.

Each starts from a golden file, is taken apart into chunks, damaged in one way, and put together with right checksums, so that
nothing but the one clause is broken. Usage: make_malformed.py [FOLDER]; FOLDER defaults to this script's.
"""
import csv
import os
import struct
import sys

import xxhash
import zstandard

HERE = os.path.dirname(os.path.abspath(__file__))
GOLDEN = os.path.join(HERE, "..", "golden", "v1")
UNSUPPORTED = {1003, 1004, 1014, 2001, 2008, 2010}


def hash64(data):
    return xxhash.xxh3_64_intdigest(data)


def digest(data):
    return hash64(b"".join(struct.pack("<Q", hash64(data[i:i + 2**20])) for i in range(0, len(data), 2**20)))


def pad(data):
    return data + bytes(-len(data) % 64)


class Chunk:
    """A chunk as its writer sees it; fields that are None are computed."""

    def __init__(self, kind, flags, raw, codec=0, stored=None):
        self.kind, self.flags, self.raw, self.codec = kind, flags, raw, codec
        self.stored = raw if stored is None else stored
        self.raw_size = self.stored_size = self.checksum = self.header_checksum = None
        self.reserved12, self.reserved40 = 0, bytes(16)
        self.padding = None

    def bytes(self):
        raw_size = len(self.raw) if self.raw_size is None else self.raw_size
        stored_size = len(self.stored) if self.stored_size is None else self.stored_size
        checksum = digest(self.stored) if self.checksum is None else self.checksum
        header = struct.pack("<4s3I3Q", self.kind, self.flags, self.codec, self.reserved12, raw_size, stored_size, checksum)
        header += self.reserved40
        header += struct.pack("<Q", hash64(header) if self.header_checksum is None else self.header_checksum)
        padding = bytes(-len(self.stored) % 64) if self.padding is None else self.padding
        return header + self.stored + padding


class File:
    def __init__(self, name):
        data = open(os.path.join(GOLDEN, name + ".bvhx"), "rb").read()
        self.signature = data[:12]
        self.version = struct.unpack_from("<4H", data, 12)
        self.reserved = bytes(36)
        self.header_checksum = None
        self.chunks, self.tail = [], b""
        self.hash = self.count = self.size = None
        self.end = Chunk(b"END ", 1, b"")
        self.end_reserved = 0
        at = 64
        while True:
            kind, flags, codec, _, raw_size, size, _ = struct.unpack_from("<4s3I3Q", data, at)
            if kind == b"END ":
                break
            stored = data[at + 64:at + 64 + size]
            assert codec < 2, "no case starts from a file with differences"
            raw = zstandard.decompress(stored, raw_size) if codec else stored
            self.chunks.append(Chunk(kind, flags, raw, codec, stored))
            at += 64 + size + (-size % 64)

    def __getitem__(self, kind):
        return next(c for c in self.chunks if c.kind == kind.encode())

    def patch(self, kind, offset, fmt, *values):
        chunk = self[kind]
        data = bytearray(chunk.raw)
        struct.pack_into("<" + fmt, data, offset, *values)
        chunk.raw = chunk.stored = bytes(data)
        return self

    def replace(self, kind, raw):
        self[kind].raw = self[kind].stored = raw
        return self

    def index(self, kind):
        return self.chunks.index(self[kind])

    def bytes(self):
        header = self.signature + struct.pack("<4H", *self.version) + self.reserved
        header += struct.pack("<Q", hash64(header) if self.header_checksum is None else self.header_checksum)
        body = header + b"".join(c.bytes() for c in self.chunks)
        records = b"".join(struct.pack("<4sIQQ", c.kind, c.flags, len(c.raw), digest(c.raw)) for c in self.chunks if c.kind != b"PROV")
        content = hash64(records) if self.hash is None else self.hash
        count = len(self.chunks) if self.count is None else self.count
        size = len(body) + 128 if self.size is None else self.size
        if not self.end.stored:
            self.end.raw = self.end.stored = struct.pack("<4Q", content, count, size, self.end_reserved)
        return body + self.end.bytes() + self.tail


CASES = []


def case(clause, name, base="two_triangles"):
    """Registers a function that damages a File, or returns the damaged bytes."""
    def register(function):
        CASES.append((clause, name, base, function))
        return function
    return register


def simple(clause, name, function, base="two_triangles"):
    CASES.append((clause, name, base, function))


def set_field(owner, **fields):
    for key, value in fields.items():
        setattr(owner, key, value)


# --- the file's header
simple(1001, "text", lambda f: b"# a wavefront file\nv 0 0 0\n" + bytes(100))
simple(1001, "crlf_to_lf", lambda f: f.bytes().replace(b"\r\n", b"\n"))
simple(1001, "lf_to_crlf", lambda f: f.bytes().replace(b"\n", b"\r\n"))
simple(1001, "seven_bits", lambda f: bytes(b & 127 for b in f.bytes()))
simple(1002, "header_checksum", lambda f: set_field(f, header_checksum=1))
simple(1003, "major_2", lambda f: set_field(f, version=(2, 0, 2, 0), reserved=bytes(range(36))))
simple(1004, "reader_1_1", lambda f: set_field(f, version=(1, 1, 1, 1)))
simple(1005, "major_0", lambda f: set_field(f, version=(0, 9, 0, 9)))
simple(1005, "reader_after_version", lambda f: set_field(f, version=(1, 0, 1, 1)))
simple(1006, "header_reserved", lambda f: set_field(f, reserved=bytes(35) + b"\1"))

# --- chunks
simple(1010, "empty", lambda f: b"")
simple(1010, "in_signature", lambda f: f.bytes()[:7])
simple(1010, "in_header", lambda f: f.bytes()[:40])
simple(1010, "no_chunk", lambda f: f.bytes()[:64])
simple(1010, "in_chunk_header", lambda f: f.bytes()[:100])
simple(1010, "in_payload", lambda f: f.bytes()[:0x110])
simple(1010, "in_padding", lambda f: f.bytes()[:0x138])
simple(1010, "without_end", lambda f: f.bytes()[:-128])
simple(1010, "in_end_padding", lambda f: f.bytes()[:-1])


@case(1010, "huge_payload")
def huge_payload(f):
    f.chunks.insert(1, Chunk(b"xNEW", 0, b"?"))
    set_field(f.chunks[1], raw_size=2**47, stored_size=2**47)


simple(1011, "chunk_header_checksum", lambda f: set_field(f["VERT"], header_checksum=1))
simple(1012, "reserved_12", lambda f: set_field(f["VERT"], reserved12=1))
simple(1012, "reserved_40", lambda f: set_field(f["VERT"], reserved40=b"\1" + bytes(15)))
simple(1012, "flag_3", lambda f: set_field(f["VERT"], flags=15))
simple(1013, "type", lambda f: set_field(f["VERT"], kind=b"V\xE9RT"))
simple(1014, "codec_4", lambda f: set_field(f["VERT"], codec=4))
simple(1015, "none_with_two_sizes", lambda f: set_field(f["VERT"], raw_size=24))
simple(1015, "over_2_48", lambda f: set_field(f["VERT"], raw_size=2**63, stored_size=2**63))
simple(1015, "zstd_of_nothing", lambda f: f.chunks.insert(1, Chunk(b"xNEW", 0, b"", 1, zstandard.compress(b""))))
simple(1016, "payload_checksum", lambda f: set_field(f["VERT"], checksum=1))
simple(1017, "padding", lambda f: set_field(f["VERT"], padding=bytes(15) + b"\1"))
simple(1017, "end_padding", lambda f: set_field(f.end, padding=bytes(31) + b"\1"))


@case(1015, "zstd_bomb")
def zstd_bomb(f):
    zeros = bytes(2**24)
    stored = b"".join(zstandard.compress(zeros[i:i + 2**20]) for i in range(0, len(zeros), 2**20))
    f.chunks.insert(1, Chunk(b"xNEW", 0, zeros, 1, stored))


def zstd_case(name, make):
    """An ancillary chunk with this stored payload; its raw payload is 3000 bytes that hardly compress."""
    def damage(f):
        raw = b"".join(struct.pack("<Q", hash64(bytes([i % 256, i // 256]))) for i in range(375))
        f.chunks.insert(1, Chunk(b"xNEW", 0, raw, 1, make(raw)))
    simple(1018, name, damage)


simple(1018, "numbers_cut", lambda f: f.chunks.insert(1, Chunk(b"xNEW", 0, bytes(5), 2, zstandard.compress(bytes(5)))))
simple(1018, "numbers_of_no_frame", lambda f: f.chunks.insert(1, Chunk(b"xNEW", 0, bytes(8), 3, bytes(8))))
zstd_case("no_zstd", lambda raw: raw)
zstd_case("cut_frame", lambda raw: zstandard.compress(raw)[:-1])
def reserved_block(raw):
    frame = bytearray(zstandard.compress(raw))
    frame[zstandard.frame_header_size(bytes(frame))] |= 6  # block type 3 is reserved
    return bytes(frame)


zstd_case("damaged_frame", reserved_block)
zstd_case("trailing_byte", lambda raw: zstandard.compress(raw) + b"\0")
zstd_case("skippable_frame", lambda raw: zstandard.compress(raw) + b"\x50\x2A\x4D\x18\4\0\0\0....")
zstd_case("two_frames_in_a_block", lambda raw: zstandard.compress(raw[:1500]) + zstandard.compress(raw[1500:]))
zstd_case("too_short", lambda raw: zstandard.compress(raw[:-1]))
zstd_case("too_long", lambda raw: zstandard.compress(raw + b"\0"))
zstd_case("no_content_size", lambda raw: zstandard.ZstdCompressor(write_content_size=False).compress(raw))

# --- END
simple(1020, "end_flags", lambda f: set_field(f.end, flags=0))
simple(1020, "end_size", lambda f: set_field(f.end, stored=bytes(31), raw=bytes(31)))
simple(1020, "end_reserved", lambda f: set_field(f, end_reserved=1))
simple(1021, "chunk_count", lambda f: set_field(f, count=6))
simple(1021, "file_size", lambda f: set_field(f, size=1151))
simple(1022, "content_hash", lambda f: set_field(f, hash=1))
simple(1023, "trailing_byte", lambda f: set_field(f, tail=b"\0"))
simple(1023, "two_files", lambda f: set_field(f, tail=File("one_leaf").bytes()))

# --- which chunks
simple(2001, "unknown_critical", lambda f: f.chunks.insert(1, Chunk(b"NEWC", 1, b"?")))
simple(2002, "nothing_but_end", lambda f: f.chunks.clear())
for kind in ("SCEN", "VERT", "TRIS", "GEOM", "TREE", "NODE", "PRIM"):
    simple(2002, "no_" + kind.lower(), lambda f, k=kind: f.chunks.remove(f[k]))
simple(2002, "order", lambda f: f.chunks.insert(1, f.chunks.pop(2)))
simple(2002, "srcp_unannounced", lambda f: f.chunks.insert(4, Chunk(b"SRCP", 7, bytes(8))))
simple(2002, "prov_first", lambda f: f.chunks.insert(0, Chunk(b"PROV", 6, bytes(8))))
simple(2002, "draco_in_raw", lambda f: f.chunks.insert(1, Chunk(b"DRCO", 7, bytes(8))))
simple(2002, "raw_in_draco", lambda f: f.patch("SCEN", 32, "I", 1))
simple(2003, "twice", lambda f: f.chunks.insert(2, f["VERT"]))
simple(2003, "prov_twice", lambda f: f.chunks.extend([Chunk(b"PROV", 6, bytes(8)), Chunk(b"PROV", 6, bytes(8))]))
simple(2004, "flags", lambda f: set_field(f["VERT"], flags=6))
for kind in ("SCEN", "VERT", "TRIS", "GEOM", "TREE", "NODE", "PRIM"):
    simple(2005, "size_of_" + kind.lower(), lambda f, k=kind: f.replace(k, f[k].raw + bytes(4)))
simple(2005, "size_of_srcp", lambda f: f.replace("SRCP", f["SRCP"].raw[:-4]), "grid_none")
simple(2006, "scene_reserved", lambda f: f.patch("SCEN", 63, "B", 1))
simple(2006, "scene_flag", lambda f: f.patch("SCEN", 36, "I", 4))
simple(2006, "tree_reserved_4", lambda f: f.patch("TREE", 4, "I", 1))
simple(2006, "tree_reserved_36", lambda f: f.patch("TREE", 36, "B", 1))
simple(2006, "prov_reserved", lambda f: f.patch("PROV", 4, "I", 1), "grid_none")
simple(2007, "no_vertices", lambda f: f.patch("SCEN", 0, "Q", 0))
simple(2007, "no_triangles", lambda f: f.patch("SCEN", 8, "Q", 0))
simple(2007, "2_31_triangles", lambda f: f.patch("SCEN", 8, "Q", 2**31))
simple(2007, "2_32_vertices", lambda f: f.patch("SCEN", 0, "Q", 2**32))
simple(2007, "vertices_that_overflow", lambda f: f.patch("SCEN", 0, "Q", (2**64 + 48) // 12))
simple(2007, "no_geometries", lambda f: f.patch("SCEN", 16, "Q", 0))
simple(2007, "2_32_name_bytes", lambda f: f.patch("SCEN", 24, "Q", 2**32))
simple(2008, "geometry_encoding", lambda f: f.patch("SCEN", 32, "I", 2))
simple(2009, "triangles_of_geometries", lambda f: f.patch("GEOM", 0, "I", 3))
simple(2009, "names_of_geometries", lambda f: f.patch("GEOM", 4, "I", 2))
simple(2010, "form", lambda f: f.patch("TREE", 0, "4s", b"best"))
simple(2011, "odd_slots", lambda f: f.patch("TREE", 8, "Q", 3))
simple(2011, "no_slots", lambda f: f.patch("TREE", 8, "Q", 0))
simple(2011, "more_slots_than_leaves_need", lambda f: f.patch("TREE", 8, "Q", 6))
simple(2011, "too_few_references", lambda f: f.patch("TREE", 16, "Q", 1))
simple(2011, "2_32_references", lambda f: f.patch("TREE", 16, "Q", 2**32))
simple(2011, "depth_97", lambda f: f.patch("TREE", 32, "I", 97))
simple(2012, "negative_cost", lambda f: f.patch("TREE", 24, "f", -1))
simple(2012, "nan_cost", lambda f: f.patch("TREE", 28, "f", float("nan")))
simple(2013, "prov_cut", lambda f: f.replace("PROV", f["PROV"].raw[:-1]), "grid_none")
simple(2013, "prov_tail", lambda f: f.replace("PROV", f["PROV"].raw + b"\0"), "grid_none")
simple(2013, "prov_too_short", lambda f: f.replace("PROV", bytes(7)), "grid_none")
simple(2013, "prov_2_32_entries", lambda f: f.patch("PROV", 0, "I", 2**32 - 1), "grid_none")
simple(2014, "name", lambda f: f.patch("GEOM", 8, "B", 0xFF))
simple(2014, "prov_overlong", lambda f: f.patch("PROV", 12, "2B", 0xC0, 0x80), "grid_none")
simple(2014, "prov_surrogate", lambda f: f.patch("PROV", 12, "3B", 0xED, 0xA0, 0x80), "grid_none")
simple(2015, "draco_garbage", lambda f: f.replace("DRCO", bytes(100)), "grid_draco")
simple(2015, "draco_cut", lambda f: f.replace("DRCO", f["DRCO"].raw[:-20]), "grid_draco")
simple(2015, "draco_other_counts", lambda f: f.patch("SCEN", 0, "Q", 50), "grid_draco")

# --- the aabb form. two_triangles: node 0 is the root, nodes 2 and 3 are its leaves
NODE, FIRST, COUNT = 32, 24, 28
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

# --- the ssh form. two_triangles_ssh: FORM has the root's box; nodes are 8 bytes: plane, then the word
SSH = "two_triangles_ssh"


def word(f, node):
    return struct.unpack_from("<I", f["NODE"].raw, 8 * node + 4)[0]


simple(2006, "ssh_form_reserved", lambda f: f.patch("FORM", 24, "B", 1), SSH)
simple(2005, "ssh_form_size", lambda f: f.replace("FORM", f["FORM"].raw + bytes(4)), SSH)
simple(2011, "ssh_references", lambda f: f.patch("TREE", 8, "2Q", 2**26, 2**25 + 2), SSH)
simple(3001, "ssh_slot_1", lambda f: f.patch("NODE", 8, "f", -0.0), SSH)
simple(3002, "ssh_own_child", lambda f: f.patch("NODE", 4, "I", word(f, 0) & 31), SSH)
simple(3002, "ssh_child_out_of_range", lambda f: f.patch("NODE", 4, "I", word(f, 0) & 31 | 2 << 5), SSH)
simple(3004, "ssh_leaf_out_of_range", lambda f: f.patch("NODE", 8 * 3 + 4, "I", word(f, 3) | 1 << 30), SSH)
simple(3005, "ssh_overlap", lambda f: f.patch("NODE", 8 * 3 + 4, "I", word(f, 2)), SSH)
simple(3009, "ssh_depth", lambda f: f.patch("TREE", 32, "I", 2), SSH)
simple(3010, "ssh_side_6", lambda f: f.patch("NODE", 8 * 2 + 4, "I", word(f, 2) & ~7 | 6), SSH)
simple(3010, "ssh_side_7", lambda f: f.patch("NODE", 4, "I", word(f, 0) | 7), SSH)
simple(4001, "ssh_nan_plane", lambda f: f.patch("NODE", 8 * 2, "f", float("nan")), SSH)
simple(4001, "ssh_infinite_root", lambda f: f.patch("FORM", 20, "f", float("inf")), SSH)
simple(4002, "ssh_plane_outside", lambda f: f.patch("NODE", 8 * 2, "f", 100 if word(f, 2) & 7 > 2 else -100), SSH)
simple(4003, "ssh_triangle_outside", lambda f: f.patch("NODE", 8 * 3 + 4, "I", word(f, 3) & ~7 | 5).patch("NODE", 8 * 3, "f", 1.5), SSH)

# --- the two-level form. two_triangles_two_level: one BLAS, in the ssh form; two_leaves_two_level: two BLASes of a leaf each, in aabb
TWO, TWO_LEAVES = "two_triangles_two_level", "two_leaves_two_level"


def blas_word(f, node):
    return struct.unpack_from("<I", f["BLAS"].raw, 8 * node + 4)[0]


def two_level_case(clause, name, chunk, offset, fmt, *values, base=TWO):
    simple(clause, "two_level_" + name, lambda f: f.patch(chunk, offset, fmt, *values), base)


two_level_case(2006, "leaf_size_of_ssh", "FORM", 12, "I", 4)
two_level_case(2006, "reserved_32", "FORM", 32, "B", 1)
two_level_case(2010, "tlas_form", "FORM", 0, "4s", b"ssh ")
two_level_case(2010, "blas_form", "FORM", 4, "4s", b"best")
two_level_case(2011, "no_size", "FORM", 8, "I", 0)
two_level_case(2011, "size_65536", "FORM", 8, "I", 65536)
two_level_case(2011, "no_slots", "FORM", 16, "Q", 0)
two_level_case(2011, "odd_slots", "FORM", 16, "Q", 3)
two_level_case(2011, "too_many_slots", "FORM", 16, "Q", 6)
two_level_case(2011, "slots_2_63", "FORM", 16, "Q", 2**63)
two_level_case(2011, "no_blas", "FORM", 24, "Q", 0)
two_level_case(2011, "too_many_blases", "FORM", 24, "Q", 3)
simple(2011, "two_level_ssh_references", lambda f: f.patch("TREE", 16, "Q", 2**25 + 1), TWO)
for kind in ("FORM", "TLAS", "ROOT", "BLAS", "PRIM"):
    simple(2005, "two_level_size_of_" + kind.lower(), lambda f, k=kind: f.replace(k, f[k].raw + bytes(4)), TWO)
    simple(2002, "two_level_no_" + kind.lower(), lambda f, k=kind: f.chunks.remove(f[k]), TWO)
two_level_case(3001, "slot_1", "TLAS", 32, "f", -0.0)
two_level_case(3002, "tlas_child", "TLAS", 24, "I", 4, base=TWO_LEAVES)
two_level_case(3002, "tlas_own_child", "TLAS", 24, "I", 0, base=TWO_LEAVES)
two_level_case(3002, "aabb_root", "ROOT", 0, "2I", 0, 0, base=TWO_LEAVES)
simple(3002, "two_level_ssh_root", lambda f: f.patch("ROOT", 0, "I", f["ROOT"].raw[0] & 31 | 1 << 5), TWO)
simple(3002, "two_level_own_child", lambda f: f.patch("BLAS", 8 + 4, "I", blas_word(f, 1) & 7), TWO)
simple(3003, "two_level_no_parent", lambda f: f.patch("ROOT", 0, "I", 3 << 3 | 1 << 30), TWO)
two_level_case(3004, "count_2", "TLAS", 28, "I", 2)
two_level_case(3004, "no_such_blas", "TLAS", 24, "I", 1)
two_level_case(3005, "same_blas", "TLAS", 3 * NODE + FIRST, "I", 0, base=TWO_LEAVES)
simple(3010, "two_level_root_side", lambda f: f.patch("ROOT", 0, "I", f["ROOT"].raw[0] | 1), TWO)
simple(3010, "two_level_side", lambda f: f.patch("BLAS", 4, "I", blas_word(f, 0) | 7), TWO)
simple(4002, "two_level_plane_outside", lambda f: f.patch("BLAS", 0, "f", 100 if blas_word(f, 0) & 7 > 2 else -100), TWO)
two_level_case(4001, "infinite_box", "TLAS", 12, "f", float("inf"))
two_level_case(4003, "triangle_outside", "TLAS", 20, "f", 1.5)
# --- the aabb form as topology. two_triangles_topology: node 0 is inner, nodes 2 and 3 are leaves of one entry: a byte behind the header
TOPOLOGY, SHUFFLED, SPLIT = "two_triangles_topology", "grid_shuffled_topology", "split_triangle_topology"
simple(2002, "topology_and_nodes", lambda f: f.chunks.insert(f.index("PRIM") + 1, Chunk(b"TOPO", 1, bytes(65))))
simple(2002, "topology_first", lambda f: f.chunks.insert(f.index("PRIM"), f.chunks.pop(f.index("TOPO"))), TOPOLOGY)
simple(2005, "topology_header_cut", lambda f: f.replace("TOPO", bytes(63)), TOPOLOGY)
simple(2005, "topology_too_short", lambda f: f.replace("TOPO", f["TOPO"].raw[:-1]), TOPOLOGY)
simple(2005, "topology_too_long", lambda f: f.replace("TOPO", f["TOPO"].raw + b"\0"), TOPOLOGY)
simple(2006, "topology_reserved_12", lambda f: f.patch("TOPO", 12, "I", 1), TOPOLOGY)
simple(2006, "topology_reserved_63", lambda f: f.patch("TOPO", 63, "B", 1), TOPOLOGY)
simple(2006, "topology_bit_of_slot_1", lambda f: f.patch("TOPO", 64, "B", 0b0011), TOPOLOGY)
simple(2006, "topology_bit_of_no_slot", lambda f: f.patch("TOPO", 64, "B", 0b10001), TOPOLOGY)
simple(2016, "topology_order_2", lambda f: f.patch("TOPO", 0, "I", 2), TOPOLOGY)
simple(2016, "topology_ranges_2", lambda f: f.patch("TOPO", 4, "I", 2), TOPOLOGY)
simple(2016, "topology_leaf_sizes_of_3_bytes", lambda f: f.patch("TOPO", 8, "I", 3), TOPOLOGY)
simple(2016, "topology_2_64_boxes", lambda f: f.patch("TOPO", 16, "2Q", 2**64 - 1, 2**64 - 1), TOPOLOGY)
simple(2016, "topology_2_62_planes", lambda f: f.patch("TOPO", 24, "Q", 2**62), TOPOLOGY)
simple(2016, "topology_two_inner_nodes", lambda f: f.patch("TOPO", 64, "B", 0b0101), TOPOLOGY)
simple(2016, "topology_root_is_leaf", lambda f: f.patch("TOPO", 64, "B", 0b0100), TOPOLOGY)


def bitmap_size(f):
    return (struct.unpack_from("<Q", f["TREE"].raw, 8)[0] + 7) // 8


def patch_parent(f, pair, distance):
    """Of the shuffled grid, which has under 128 pairs: the lowest byte is all."""
    return f.patch("TOPO", 64 + bitmap_size(f) + pair - 1, "B", distance)


def distance_of(f, pair):
    return f["TOPO"].raw[64 + bitmap_size(f) + pair - 1]


def leaf_in_front(f, pair):
    inner = f["TOPO"].raw[64:]
    return next(i for i in range(2 * pair - 1, 1, -1) if not inner[i // 8] >> i % 8 & 1)


simple(2016, "topology_own_parent", lambda f: patch_parent(f, 5, 0), SHUFFLED)
simple(2016, "topology_parent_before_root", lambda f: patch_parent(f, 5, 11), SHUFFLED)
simple(2016, "topology_parent_is_leaf", lambda f: patch_parent(f, 12, 24 - leaf_in_front(f, 12)), SHUFFLED)
simple(2016, "topology_parent_of_two_pairs", lambda f: patch_parent(f, 2, distance_of(f, 1) + 2), SHUFFLED)
simple(3004, "topology_range_outside", lambda f: f.patch("TOPO", 4, "I", 1).replace(
    "TOPO", f["TOPO"].raw + bytes([0, 2] + 6 * [0])), TOPOLOGY)
simple(3004, "topology_range_before_first", lambda f: f.patch("TOPO", 4, "I", 1).replace(
    "TOPO", f["TOPO"].raw + bytes([1, 1] + 6 * [0])), TOPOLOGY)
simple(3005, "topology_ranges_overlap", lambda f: f.patch("TOPO", 4, "I", 1).replace(
    "TOPO", f["TOPO"].raw + bytes([0, 1] + 6 * [0])), TOPOLOGY)
simple(3004, "topology_leaf_of_65536", lambda f: f.patch("TOPO", 8, "I", 2).replace(
    "TOPO", f["TOPO"].raw + bytes([255, 0, 255, 0])), TOPOLOGY)
simple(3005, "topology_too_many_entries", lambda f: f.patch("TOPO", 8, "I", 1).replace("TOPO", f["TOPO"].raw + bytes([1, 0])), TOPOLOGY)
simple(3006, "topology_primitive", lambda f: f.patch("PRIM", 0, "I", 2), TOPOLOGY)
simple(3009, "topology_depth", lambda f: f.patch("TREE", 32, "I", 2), TOPOLOGY)

# split_triangle_topology: behind the header a bitmap, 2 firsts, 2 sizes, a bitmap of nodes 2 and 3, their sides (max x; min x and max y),
# and the planes: min x of node 3, max x of node 2, max y of node 3
simple(2016, "topology_box_count", lambda f: f.patch("TOPO", 75, "B", 0b0100), SPLIT)
simple(2016, "topology_no_side", lambda f: f.patch("TOPO", 76, "2B", 0, 0b011001), SPLIT)
simple(2016, "topology_side_6", lambda f: f.patch("TOPO", 76, "B", 0b1001000), SPLIT)
simple(2016, "topology_plane_count", lambda f: f.patch("TOPO", 76, "B", 0b011000), SPLIT)
simple(4001, "topology_nan_plane", lambda f: f.patch("TOPO", 78, "f", float("nan")), SPLIT)
simple(4003, "topology_triangle_outside", lambda f: f.patch("TOPO", 82, "f", 0.5), SPLIT)


@case(3008, "topology_depth_97", TOPOLOGY)
def topology_too_deep(f):
    # Each left child is a leaf, each right one inner, but for the last.
    pairs = 98
    inner = [i == 0 or i > 1 and i % 2 == 1 and i < 2 * pairs - 2 for i in range(2 * pairs)]
    bitmap = bytes(sum(bit << k for k, bit in enumerate(inner[i:i + 8])) for i in range(0, len(inner), 8))
    f.replace("VERT", struct.pack("<3f", 1, 1, 1)).replace("TRIS", bytes(12 * pairs)).patch("GEOM", 0, "I", pairs)
    f.patch("SCEN", 0, "2Q", 1, pairs).patch("TREE", 8, "2Q", 2 * pairs, pairs).patch("TREE", 32, "I", 96)
    f.replace("PRIM", struct.pack(f"<{pairs}I", *range(pairs))).replace("TOPO", f["TOPO"].raw[:64] + bitmap)

# --- the mvh form. two_triangles_mvh: leaves of 1, so one nibble; FORM has the root's box, zetas, axes and the leaves' size
MVH = "two_triangles_mvh"
simple(2006, "mvh_form_reserved", lambda f: f.patch("FORM", 63, "B", 1), MVH)
simple(2006, "mvh_spare_nibble", lambda f: f.patch("NODE", 0, "I", 0x12), MVH)
simple(2005, "mvh_form_size", lambda f: f.replace("FORM", f["FORM"].raw + bytes(4)), MVH)
simple(2005, "mvh_words", lambda f: f.replace("NODE", f["NODE"].raw + bytes(4)), MVH)
simple(2011, "mvh_references", lambda f: f.patch("TREE", 16, "Q", 3), MVH)
simple(2011, "mvh_slots", lambda f: f.patch("TREE", 8, "Q", 2), MVH)
simple(2019, "mvh_zeta_0", lambda f: f.patch("FORM", 24, "f", 0), MVH)
simple(2019, "mvh_zeta_1", lambda f: f.patch("FORM", 24, "f", 1), MVH)
simple(2019, "mvh_zeta_nan", lambda f: f.patch("FORM", 24, "f", float("nan")), MVH)
simple(2019, "mvh_zeta_of_both", lambda f: f.patch("FORM", 28, "f", 0.51), MVH)
simple(2019, "mvh_no_axes", lambda f: f.patch("FORM", 32, "I", 0), MVH)
simple(2019, "mvh_4_axes", lambda f: f.patch("FORM", 32, "I", 4), MVH)
simple(2019, "mvh_leaf_size_0", lambda f: f.patch("FORM", 36, "I", 0), MVH)
simple(2019, "mvh_leaf_size_17", lambda f: f.patch("FORM", 36, "I", 17), MVH)
simple(3006, "mvh_primitive", lambda f: f.patch("PRIM", 4, "I", 2), MVH)
simple(3007, "mvh_missing_triangle", lambda f: f.patch("PRIM", 4, "I", 0), MVH)
simple(3009, "mvh_depth", lambda f: f.patch("TREE", 32, "I", 2), MVH)
simple(4001, "mvh_infinite_root", lambda f: f.patch("FORM", 20, "f", float("inf")), MVH)
simple(4001, "mvh_inverted_root", lambda f: f.patch("FORM", 12, "f", -1), MVH)
simple(4003, "mvh_low_cut", lambda f: f.patch("NODE", 0, "I", 1), MVH)
simple(4003, "mvh_cut_of_the_other", lambda f: f.patch("NODE", 0, "I", 8), MVH)

# --- the quantized form. two_triangles_quantized: FORM has the root's box and the bits; one record of 16 bytes
QUAN = "two_triangles_quantized"
simple(2005, "quantized_form_size", lambda f: f.replace("FORM", f["FORM"].raw + bytes(4)), QUAN)
simple(2005, "quantized_record_missing", lambda f: f.patch("TREE", 8, "2Q", 6, 3), QUAN)
simple(2006, "quantized_form_reserved", lambda f: f.patch("FORM", 63, "B", 1), QUAN)
simple(2011, "quantized_references", lambda f: f.patch("TREE", 8, "2Q", 2**29, 2**29 + 1), QUAN)
simple(2011, "quantized_large_leaf", lambda f: f.patch("TREE", 8, "2Q", 2, 129), QUAN)
simple(2019, "quantized_bits_4", lambda f: f.patch("FORM", 24, "I", 4), QUAN)
simple(2019, "quantized_bits_9", lambda f: f.patch("FORM", 24, "I", 9), QUAN)
simple(3002, "quantized_own_child", lambda f: f.patch("NODE", 8, "I", 0), QUAN)
simple(3002, "quantized_child_out_of_range", lambda f: f.patch("NODE", 12, "I", 1), QUAN)
simple(3004, "quantized_leaf_out_of_range", lambda f: f.patch("NODE", 12, "I", 2**31 + 2), QUAN)
simple(3004, "quantized_leaf_too_long", lambda f: f.patch("NODE", 7, "B", 2 | 1 << 3), QUAN)
simple(3005, "quantized_overlap", lambda f: f.patch("NODE", 12, "I", 2**31), QUAN)
simple(3009, "quantized_depth", lambda f: f.patch("TREE", 32, "I", 2), QUAN)
simple(3010, "quantized_inset_32", lambda f: f.patch("FORM", 24, "I", 5).patch("NODE", 0, "8B", 0, 0, 0, 0, 32, 0, 31, 2), QUAN)
simple(3010, "quantized_more_of_inner", lambda f: f.patch("NODE", 3, "B", 1 << 3).patch("NODE", 8, "I", 1), QUAN)
simple(4001, "quantized_nan_root", lambda f: f.patch("FORM", 0, "f", float("nan")), QUAN)
simple(4001, "quantized_root_inside_out", lambda f: f.patch("FORM", 0, "f", 1.5), QUAN)
simple(4001, "quantized_crossing_planes", lambda f: f.patch("NODE", 0, "8B", 0, 0, 200, 0, 0, 0, 255, 0), QUAN)
simple(4003, "quantized_triangle_outside", lambda f: f.patch("NODE", 0, "8B", 0, 0, 0, 0, 0, 255, 255, 0), QUAN)


@case(3003, "quantized_shared_record", "grid_quantized_6")
def shared_record(f):
    # Both children of the root have the left one's record.
    f.patch("NODE", 12, "I", struct.unpack_from("<I", f["NODE"].raw, 8)[0])


# --- the quantized-short form. two_triangles_quantized_short: one slot; the grid has clusters of at most 8 slots, and LAST
QUSH, SHORT_GRID = "two_triangles_quantized_short", "grid_quantized_short"


def short_slot(f, wanted):
    """The first slot whose words are as wanted."""
    return next(i for i, words in enumerate(struct.iter_unpack("<2I", f["NODE"].raw)) if wanted(*words))


def patch_slot(f, slot, low, high):
    return f.patch("NODE", 8 * slot, "2I", low, high)


def is_glue(low, high):
    return low < 2**21 and (low, high) != (0, 0)


simple(2005, "short_form_size", lambda f: f.replace("FORM", f["FORM"].raw + bytes(4)), QUSH)
simple(2005, "short_slot_missing", lambda f: f.patch("FORM", 32, "Q", 2), QUSH)
simple(2005, "short_last_cut", lambda f: f.replace("LAST", f["LAST"].raw[:-4]), SHORT_GRID)
simple(2006, "short_form_reserved", lambda f: f.patch("FORM", 63, "B", 1), QUSH)
simple(2006, "short_bit_of_no_entry", lambda f: f.patch("LAST", len(f["LAST"].raw) - 1, "B", 1), SHORT_GRID)
simple(2011, "short_references", lambda f: f.patch("TREE", 8, "2Q", 2**27, 2**27 + 1), QUSH)
simple(2011, "short_large_leaf", lambda f: f.patch("TREE", 8, "2Q", 2, 33), QUSH)
simple(2011, "short_node_slots", lambda f: f.patch("TREE", 8, "Q", struct.unpack_from("<Q", f["TREE"].raw, 8)[0] + 2), SHORT_GRID)
simple(2019, "short_pointer_bits_1", lambda f: f.patch("FORM", 24, "I", 1), QUSH)
simple(2019, "short_pointer_bits_11", lambda f: f.patch("FORM", 24, "I", 11), QUSH)
simple(2019, "short_lines_of_3", lambda f: f.patch("FORM", 28, "I", 3), QUSH)
simple(2019, "short_lines_of_128", lambda f: f.patch("FORM", 28, "I", 128), QUSH)
simple(2019, "short_2_32_slots", lambda f: f.patch("FORM", 32, "Q", 2**32), QUSH)
simple(3002, "short_own_child", lambda f: f.patch("NODE", 4, "I", 0x000BFFC0), QUSH)
simple(3002, "short_child_out_of_range", lambda f: f.patch("NODE", 4, "I", 0x000BFFC0 | 1 << 21), QUSH)
simple(3002, "short_child_in_empty_slot", lambda f: patch_slot(f, short_slot(f, is_glue), 0, 0), SHORT_GRID)
simple(3002, "short_glue_first", lambda f: f.patch("NODE", 0, "I", 1), QUSH)
simple(3002, "short_glue_backwards", lambda f: patch_slot(f, short_slot(f, is_glue), 0, 1), SHORT_GRID)
simple(3002, "short_glue_out_of_range", lambda f: patch_slot(f, short_slot(f, is_glue), 2**21 - 1, 2**32 - 1), SHORT_GRID)
simple(3003, "short_slot_of_no_parent", lambda f: patch_slot(f, short_slot(f, lambda *words: words == (0, 0)), 1, 0), SHORT_GRID)
simple(3004, "short_leaf_out_of_range", lambda f: f.patch("NODE", 4, "I", 0x000BFFC0 | 0x102 << 21), QUSH)
simple(3004, "short_leaf_without_end", lambda f: f.replace("LAST", bytes(len(f["LAST"].raw))), SHORT_GRID)
simple(3005, "short_overlap", lambda f: f.patch("NODE", 4, "I", 0x000BFFC0 | 0x100 << 21), QUSH)
simple(3009, "short_depth", lambda f: f.patch("TREE", 32, "I", 2), QUSH)
simple(4001, "short_nan_root", lambda f: f.patch("FORM", 0, "f", float("nan")), QUSH)
simple(4001, "short_root_inside_out", lambda f: f.patch("FORM", 0, "f", 1.5), QUSH)
simple(4001, "short_crossing_planes", lambda f: f.patch("NODE", 0, "2I", 50 << 12 | 0x100 << 21, 63 << 12 | 0x101 << 21), QUSH)
simple(4003, "short_triangle_outside", lambda f: f.patch("NODE", 4, "I", 63 << 6 | 63 << 12 | 0x101 << 21), QUSH)


@case(3003, "short_shared_record", SHORT_GRID)
def shared_short_record(f):
    # Both children of the root have the left one's record.
    low, high = struct.unpack_from("<2I", f["NODE"].raw)
    f.patch("NODE", 4, "I", high & (2**21 - 1) | low >> 21 << 21)


@case(3011, "short_record_behind_another_cluster", QUSH)
def record_behind_another_cluster(f):
    # Slot 1 is glue to slot 2, slot 3 again of the first cluster.
    record = [(1 << 21, 3 << 21), (2, 0), (256 << 21, 257 << 21), (258 << 21, 259 << 21)]
    f.replace("NODE", b"".join(struct.pack("<2I", *words) for words in record)).patch("FORM", 28, "IQ", 1, 4)
    f.replace("PRIM", struct.pack("<4I", 0, 1, 0, 1)).patch("TREE", 8, "2Q", 8, 4)


# --- clusters beside the aabb form. two_triangles_clusters: one slot; the grid has clusters of at most 8 slots, in lines of 2
CLUSTERS, CLUSTER_GRID = "two_triangles_clusters", "grid_clusters"


def cluster_words(f):
    return list(struct.unpack(f"<{len(f['CLUS'].raw) // 4 - 4}I", f["CLUS"].raw[16:]))


def put_cluster_words(f, words):
    return f.replace("CLUS", f["CLUS"].raw[:16] + struct.pack(f"<{len(words)}I", *words))


simple(2002, "clusters_of_quantized", lambda f: f.chunks.append(Chunk(b"CLUS", 0, struct.pack("<5I", 8, 8, 0, 0, 0))), QUAN)
simple(2004, "clusters_flags", lambda f: set_field(f["CLUS"], flags=1), CLUSTERS)
simple(2005, "clusters_no_slots", lambda f: f.replace("CLUS", f["CLUS"].raw[:16]), CLUSTERS)
simple(2005, "clusters_half_a_slot", lambda f: f.replace("CLUS", f["CLUS"].raw + bytes(2)), CLUSTERS)
simple(2006, "clusters_reserved", lambda f: f.patch("CLUS", 12, "I", 1), CLUSTERS)
simple(3011, "clusters_bits_1", lambda f: f.patch("CLUS", 0, "I", 1), CLUSTERS)
simple(3011, "clusters_bits_11", lambda f: f.patch("CLUS", 0, "I", 11), CLUSTERS)
simple(3011, "clusters_lines_of_0", lambda f: f.patch("CLUS", 4, "I", 0), CLUSTERS)
simple(3011, "clusters_no_such_pair", lambda f: f.patch("CLUS", 16, "I", 1), CLUSTERS)
simple(3011, "clusters_pair_missing", lambda f: f.patch("CLUS", 16, "I", 2**32 - 1), CLUSTERS)
simple(3011, "clusters_pair_twice", lambda f: put_cluster_words(f, [0, 0]), CLUSTERS)
simple(3011, "clusters_root_not_first", lambda f: put_cluster_words(f, [2**32 - 1, 0]), CLUSTERS)
simple(3011, "clusters_glue_to_the_root", lambda f: put_cluster_words(f, [0, 2**31]), CLUSTERS)
simple(3011, "clusters_out_of_reach", lambda f: f.patch("CLUS", 0, "I", 2), CLUSTER_GRID)
simple(3011, "clusters_within_a_line", lambda f: f.patch("CLUS", 4, "I", 64), CLUSTER_GRID)


@case(3011, "clusters_glue_elsewhere", CLUSTER_GRID)
def glue_elsewhere(f):
    # The first glue moves behind all slots, out of its cluster.
    words = cluster_words(f)
    at = next(i for i, word in enumerate(words) if 2**31 <= word < 2**32 - 1)
    words.append(words[at])
    words[at] = 2**32 - 1
    put_cluster_words(f, words)


@case(3011, "clusters_glue_missing", CLUSTER_GRID)
def glue_missing(f):
    # The first glue's cluster becomes a part of the one before it.
    put_cluster_words(f, [2**32 - 1 if 2**31 <= word else word for word in cluster_words(f)])


@case(3011, "clusters_child_first", CLUSTER_GRID)
def child_first(f):
    # Two records of the first cluster, parent and child, change places.
    words = cluster_words(f)
    at = [i for i, word in enumerate(words) if 0 < word < 2**31][:2]
    words[at[0]], words[at[1]] = words[at[1]], words[at[0]]
    put_cluster_words(f, words)


# The same with a quantized top level over mvh BLASes: TLAS has records of 16 bytes, BLAS a byte for every four triangles
OVER_MVH, ONE_MVH = "grid_quantized_over_mvh", "two_triangles_over_mvh"


def leaf_word(f):
    """Where the first leaf's word is."""
    raw = f["TLAS"].raw
    return next(at for r in range(0, len(raw), 16) for at in (r + 8, r + 12) if raw[at + 3] >> 7)


two_level_case(2006, "reserved_60", "FORM", 60, "I", 1, base=OVER_MVH)
two_level_case(2006, "box_of_aabb", "FORM", 32, "f", 1.0)
two_level_case(2006, "byte_of_no_node", "BLAS", 0, "B", 1, base=OVER_MVH)
simple(2011, "two_level_mvh_slots", lambda f: f.patch("TREE", 8, "Q", struct.unpack_from("<Q", f["TREE"].raw, 8)[0] + 2), OVER_MVH)
simple(2011, "two_level_mvh_references", lambda f: f.patch("TREE", 16, "Q", 2**29 + 1), OVER_MVH)
simple(2011, "two_level_mvh_large_root", lambda f: f.patch("TREE", 8, "2Q", 2 + 2 * 32, 129), ONE_MVH)
simple(2005, "two_level_mvh_bytes", lambda f: f.replace("BLAS", f["BLAS"].raw + b"\0"), OVER_MVH)
two_level_case(2019, "leaf_size_0", "FORM", 12, "I", 0, base=OVER_MVH)
two_level_case(2019, "leaf_size_17", "FORM", 12, "I", 17, base=OVER_MVH)
two_level_case(2019, "bits_4", "FORM", 56, "I", 4, base=OVER_MVH)
two_level_case(2019, "bits_9", "FORM", 56, "I", 9, base=OVER_MVH)
two_level_case(3002, "own_record", "TLAS", 8, "I", 0, base=OVER_MVH)
simple(3004, "two_level_mvh_run", lambda f: f.patch("TLAS", leaf_word(f), "I", struct.unpack_from("<I", f["TLAS"].raw, leaf_word(f))[0] & 7 << 29 | 72), OVER_MVH)
simple(3004, "two_level_no_such_blas_quantized", lambda f: f.patch("TLAS", leaf_word(f), "I", 1 << 31 | 71), "grid_quantized_over_ssh")
two_level_case(4001, "nan_root", "FORM", 32, "f", float("nan"), base=OVER_MVH)
simple(4003, "two_level_mvh_cuts", lambda f: f.patch("BLAS", next(i for i, b in enumerate(f["BLAS"].raw) if b), "B", 0xB1), OVER_MVH)

# The same with quantized BLASes. two_triangles_over_quantized: a top level of one leaf in aabb, one BLAS of one record
OVER_QUANTIZED = "two_triangles_over_quantized"
for kind in ("ROOT", "BLAS"):
    simple(2005, "two_level_quantized_size_of_" + kind.lower(), lambda f, k=kind: f.replace(k, f[k].raw + bytes(8)), OVER_QUANTIZED)
    simple(2002, "two_level_quantized_no_" + kind.lower(), lambda f, k=kind: f.chunks.remove(f[k]), OVER_QUANTIZED)
two_level_case(2006, "bits_of_none", "FORM", 56, "I", 8)
two_level_case(2006, "box_above_quantized", "FORM", 52, "f", 1.0, base=OVER_QUANTIZED)
simple(2011, "two_level_quantized_references", lambda f: f.patch("TREE", 16, "Q", 2**29 + 1), OVER_QUANTIZED)
two_level_case(2019, "quantized_bits_4", "FORM", 56, "I", 4, base=OVER_QUANTIZED)
two_level_case(2019, "quantized_bits_9", "FORM", 56, "I", 9, base=OVER_QUANTIZED)
two_level_case(3002, "quantized_root", "ROOT", 0, "I", 1, base=OVER_QUANTIZED)
two_level_case(3002, "quantized_own_record", "BLAS", 8, "I", 0, base=OVER_QUANTIZED)
two_level_case(3003, "quantized_no_parent", "ROOT", 0, "I", 1 << 31 | 1 << 29, base=OVER_QUANTIZED)
two_level_case(3005, "quantized_same_entry", "BLAS", 12, "I", 1 << 31, base=OVER_QUANTIZED)
two_level_case(3010, "quantized_size_of_inner_root", "ROOT", 4, "I", 8, base=OVER_QUANTIZED)
two_level_case(3010, "quantized_root_reserved", "ROOT", 0, "2I", 1 << 31 | 1 << 29, 1, base=OVER_QUANTIZED)
two_level_case(3010, "quantized_root_size_129", "ROOT", 0, "2I", 1 << 31, 0x100, base=OVER_QUANTIZED)
simple(3010, "two_level_quantized_inset", lambda f: f.patch("BLAS", 0, "B", 64), "grid_quantized_over_quantized_6")
simple(4003, "two_level_quantized_plane", lambda f: f.patch("BLAS", 0, "B", 255), OVER_QUANTIZED)

# --- visits. two_triangles_visits: five rays, three of which fetched the only pair
VISITS = "two_triangles_visits"
simple(2002, "visits_before_primitives", lambda f: f.chunks.insert(f.index("PRIM"), f.chunks.pop(f.index("VISI"))), VISITS)
simple(2002, "visits_of_ssh", lambda f: f.chunks.append(Chunk(b"VISI", 0, struct.pack("<2I", 5, 3))), "two_triangles_ssh")
simple(2003, "visits_twice", lambda f: f.chunks.append(Chunk(b"VISI", 0, f["VISI"].raw)), VISITS)
simple(2004, "visits_that_survive", lambda f: set_field(f["VISI"], flags=2), VISITS)
simple(2005, "visits_too_few", lambda f: f.replace("VISI", f["VISI"].raw[:-4]), VISITS)
simple(2005, "visits_too_many", lambda f: f.replace("VISI", f["VISI"].raw + bytes(4)), VISITS)
simple(2021, "visits_above_parent", lambda f: f.patch("VISI", 4, "I", 6), VISITS)

# --- instances. two_triangles_instances: one mesh of two triangles in two places, both levels in aabb
def instance_case(clause, name, chunk, offset, fmt, *values):
    simple(clause, "instances_" + name, lambda f: f.patch(chunk, offset, fmt, *values), "two_triangles_instances")


simple(2006, "meshes_without_flag", lambda f: f.patch("SCEN", 40, "I", 1))
simple(2006, "instances_without_flag", lambda f: f.patch("SCEN", 44, "I", 1))
instance_case(2006, "scene_flag_4", "SCEN", 36, "I", 6)
instance_case(2006, "scene_reserved", "SCEN", 48, "B", 1)
instance_case(2006, "reserved", "INST", 56, "I", 1)
instance_case(2007, "no_mesh", "SCEN", 40, "I", 0)
instance_case(2007, "too_many_meshes", "SCEN", 40, "I", 2)
instance_case(2007, "none", "SCEN", 44, "I", 0)
instance_case(2007, "two_to_the_31", "SCEN", 44, "I", 2**31)
for kind in ("MESH", "INST", "ENTR"):
    simple(2005, "instances_size_of_" + kind.lower(), lambda f, k=kind: f.replace(k, f[k].raw + bytes(4)), "two_triangles_instances")
    simple(2002, "instances_no_" + kind.lower(), lambda f, k=kind: f.chunks.remove(f[k]), "two_triangles_instances")
instance_case(2011, "too_many_slots", "TREE", 8, "Q", 10)
instance_case(2017, "empty_mesh", "MESH", 0, "I", 0)
instance_case(2017, "mesh_too_long", "MESH", 0, "I", 2)
instance_case(2017, "mesh_far_too_long", "MESH", 0, "I", 2**32 - 1)
instance_case(2018, "no_such_mesh", "INST", 48, "I", 1)
instance_case(2018, "same_geometry", "INST", 64 + 52, "I", 0)
instance_case(2018, "last_geometry", "INST", 64 + 52, "I", 2**32 - 1)
instance_case(2020, "in_aabb", "TREE", 0, "4s", b"aabb")
instance_case(2020, "in_ssh", "TREE", 0, "4s", b"ssh ")
instance_case(2020, "with_draco", "SCEN", 32, "I", 1)
simple(2020, "instances_one_leaf", lambda f: f.patch("FORM", 16, "2Q", 2, 1), "two_triangles_instances")
instance_case(3001, "slot_1", "TLAS", NODE + 4, "f", 1)
instance_case(3002, "top_child", "TLAS", FIRST, "I", 6)
instance_case(3002, "blas_child", "ROOT", 0, "I", 2)
instance_case(3003, "nodes_of_no_blas", "ROOT", 0, "2I", 0, 2)
instance_case(3003, "too_many_entries", "BLAS", NODE + COUNT, "I", 2)
instance_case(3004, "two_entries", "TLAS", 2 * NODE + COUNT, "I", 2)
instance_case(3004, "no_such_entry", "TLAS", 3 * NODE + FIRST, "I", 2)
instance_case(3005, "same_entry_range", "BLAS", NODE + FIRST, "I", 0)
instance_case(3005, "leaf_twice", "TLAS", 3 * NODE + FIRST, "I", 0)
instance_case(3006, "no_such_instance", "ENTR", 4, "I", 2)
instance_case(3006, "no_such_triangle", "PRIM", 4, "I", 2)
instance_case(3007, "same_instance", "ENTR", 4, "I", 0)
instance_case(3007, "same_triangle", "PRIM", 4, "I", 0)
instance_case(3009, "depth", "TREE", 32, "I", 2)
instance_case(4001, "infinite_box", "TLAS", 2 * NODE + 12, "f", float("inf"))
instance_case(4002, "leaf_outside_mesh", "BLAS", 12, "f", 1.5)
instance_case(4003, "instance_outside_leaf", "TLAS", 2 * NODE + 12, "f", 0.5)
instance_case(4003, "instance_without_margin", "TLAS", 2 * NODE + 12, "f", 1)
instance_case(4003, "triangle_outside_leaf", "BLAS", 12, "f", 0.5)
instance_case(4007, "nan", "INST", 12, "f", float("nan"))
instance_case(4007, "infinite", "INST", 0, "f", float("inf"))
instance_case(4007, "flat", "INST", 0, "f", 0)
# Meshes in mvh: PRIM has each triangle once, and what is below a root follows from the number of a mesh's
IN_MVH = "grid_instances_mvh"
simple(2006, "instances_mvh_byte_of_no_node", lambda f: f.patch("BLAS", 0, "B", 1), IN_MVH)
simple(2011, "instances_mvh_references", lambda f: f.patch("TREE", 16, "Q", struct.unpack_from("<Q", f["TREE"].raw, 16)[0] + 1), IN_MVH)
simple(2011, "instances_mvh_slots", lambda f: f.patch("TREE", 8, "Q", struct.unpack_from("<Q", f["TREE"].raw, 8)[0] - 2), IN_MVH)
simple(3006, "instances_mvh_other_mesh", lambda f: f.patch("PRIM", 0, "I", struct.unpack_from("<I", f["PRIM"].raw, len(f["PRIM"].raw) - 4)[0]), IN_MVH)
simple(4003, "instances_mvh_cuts", lambda f: f.patch("BLAS", next(i for i, b in enumerate(f["BLAS"].raw) if b), "B", 0xB1), IN_MVH)
simple(4003, "instances_quantized_plane", lambda f: f.patch("BLAS", 0, "B", 255), "grid_instances_quantized")
simple(4007, "instances_parallel", lambda f: f.patch("INST", 0, "12f", 1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0), "two_triangles_instances")

simple(4004, "nan_vertex", lambda f: f.patch("VERT", 4, "f", float("nan")))
simple(4004, "infinite_vertex", lambda f: f.patch("VERT", 44, "f", float("inf")))
simple(4005, "negative_zero", lambda f: f.patch("VERT", 0, "f", -0.0))
simple(4006, "vertex_index", lambda f: f.patch("TRIS", 8, "I", 4))
simple(4006, "topology_vertex_index", lambda f: f.patch("TRIS", 8, "I", 4), TOPOLOGY)
simple(4006, "vertex_index_2_32", lambda f: f.patch("TRIS", 8, "I", 2**32 - 1))


def rebuild(f, nodes, primitives, vertices=None, triangles=None, depth=None):
    """Another tree, as a list of (box, first, count), over the file's or other geometry."""
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
    """Geometry: so many triangles, all of them the one point."""
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


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else HERE
    rows = []
    for clause, name, base, damage in CASES:
        file = File(base)
        result = damage(file)
        data = result if isinstance(result, bytes) else file.bytes()
        path = f"{clause}-{name}.bvhx"
        with open(os.path.join(folder, path), "wb") as out:
            out.write(data)
        rows.append((path, "unsupported" if clause in UNSUPPORTED else "invalid", clause))
    assert len({row[0] for row in rows}) == len(rows)
    with open(os.path.join(folder, "manifest.csv"), "w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(("file", "kind", "clause"))
        writer.writerows(sorted(rows))


main()
