"""Malformed files of the mvh form: mvh.md."""
from damage import simple

# The mvh form. two_triangles_mvh: leaves of 1, so one nibble; FORM has the root's box, zetas, axes and the leaves' size
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
