"""Malformed files of the two-level form: two-level.md."""
import struct

from damage import FIRST, NODE, simple

# The two-level form. two_triangles_two_level: one BLAS, in the ssh form; two_leaves_two_level: two BLASes of a leaf each, in aabb
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


# The same with a quantized top level over mvh BLASes: TLAS has records of 16 bytes, BLAS a byte for every four triangles
OVER_MVH, ONE_MVH = "grid_quantized_over_mvh", "two_triangles_over_mvh"


def leaf_word(f):
    """Returns the place of the first leaf's word."""
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
