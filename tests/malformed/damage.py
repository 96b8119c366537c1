"""Takes golden files apart, so that cases can damage them in one way, and puts them together with correct checksums. Also the list of cases."""
import os
import struct

import xxhash
import zstandard

GOLDEN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "golden", "v1")


def hash64(data):
    return xxhash.xxh3_64_intdigest(data)


def digest(data):
    return hash64(b"".join(struct.pack("<Q", hash64(data[i:i + 2**20])) for i in range(0, len(data), 2**20)))


def pad(data):
    return data + bytes(-len(data) % 64)


class Chunk:
    """A chunk as its writer sees it. Fields that are None are computed."""

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


# Of a node in the aabb form: its bytes, and where its first and its count are.
NODE, FIRST, COUNT = 32, 24, 28
