"""Malformed files of instances: instances.md."""
import struct

from damage import COUNT, FIRST, NODE, simple

# Instances. two_triangles_instances: one mesh of two triangles in two places, both levels in aabb
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
