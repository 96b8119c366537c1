"""Malformed files of the quantized-short form: quantized-short.md."""
import struct

from damage import case, simple

# The quantized-short form. two_triangles_quantized_short: one slot; the grid has clusters of at most 8 slots, and LAST
QUSH, SHORT_GRID = "two_triangles_quantized_short", "grid_quantized_short"


def short_slot(f, wanted):
    """Returns the first slot whose words satisfy a condition."""
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
