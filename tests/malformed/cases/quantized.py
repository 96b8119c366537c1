"""Malformed files of the quantized form: quantized.md."""
import struct

from damage import case, simple

# The quantized form. two_triangles_quantized: FORM has the root's box and the bits; one record of 16 bytes
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
