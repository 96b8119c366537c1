"""Malformed files of the ssh form: ssh.md."""
import struct

from damage import simple

# The ssh form. two_triangles_ssh: FORM has the root's box; nodes are 8 bytes: plane, then the word
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
