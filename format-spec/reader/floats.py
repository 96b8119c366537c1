"""Numbers rounded to binary32, in Python's binary64."""
import math
import struct

MAX_FLOAT = struct.unpack("<f", b"\xFF\xFF\x7F\x7F")[0]


def binary32(x):
    """Of a sum or product of two binary32 numbers in binary64: rounding twice gives what rounding once does."""
    try:
        return struct.unpack("<f", struct.pack("<f", x))[0]
    except OverflowError:
        return math.copysign(math.inf, x)


def float_up(x):
    """The least binary32 number that is not below x."""
    nearest = struct.unpack("<f", struct.pack("<f", x))[0]
    if nearest >= x:
        return nearest
    bits = struct.unpack("<i", struct.pack("<f", nearest))[0]
    bits = 1 if nearest == 0 else bits + (1 if nearest > 0 else -1)
    return struct.unpack("<f", struct.pack("<i", bits))[0]


def round_down(value):
    """The largest binary32 that is not above `value`, as instances.md 3 has it."""
    if abs(value) >= MAX_FLOAT:
        return math.copysign(MAX_FLOAT, value)
    rounded = struct.unpack("<f", struct.pack("<f", value))[0]
    if rounded > value:
        bits, = struct.unpack("<i", struct.pack("<f", rounded))
        bits = bits - 1 if bits > 0 else -2**31 + 1 if bits in (0, -2**31) else bits + 1
        rounded, = struct.unpack("<f", struct.pack("<i", bits))
    return rounded + 0.0
