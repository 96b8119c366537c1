"""The container of chunks: container.md."""
import struct

import xxhash
import zstandard

from clauses import Rejected, reject_if

SIGNATURE = bytes.fromhex("9C 42 56 48 58 20 0D 0A 1A 0A 00 FE")
VERSION = (1, 0)
BLOCK = 1 << 20
MAX_SIZE = 1 << 48
MAX_EXPANSION = 32
CRITICAL = 1


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
