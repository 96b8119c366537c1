"""Malformed files of the container: container.md."""
import struct

import zstandard

from damage import Chunk, File, case, hash64, set_field, simple

# The file's header
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

# Chunks
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
    """Adds an ancillary chunk with this stored payload. Its raw payload is 3000 bytes that hardly compress."""
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
