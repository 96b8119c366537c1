"""Malformed files of the aabb form as topology: topology.md."""
import struct

from damage import Chunk, case, simple

# The aabb form as topology. two_triangles_topology: node 0 is inner, nodes 2 and 3 are leaves of one entry: a byte behind the header
TOPOLOGY, SHUFFLED, SPLIT = "two_triangles_topology", "grid_shuffled_topology", "split_triangle_topology"
simple(2002, "topology_and_nodes", lambda f: f.chunks.insert(f.index("PRIM") + 1, Chunk(b"TOPO", 1, bytes(65))))
simple(2002, "topology_first", lambda f: f.chunks.insert(f.index("PRIM"), f.chunks.pop(f.index("TOPO"))), TOPOLOGY)
simple(2005, "topology_header_cut", lambda f: f.replace("TOPO", bytes(63)), TOPOLOGY)
simple(2005, "topology_too_short", lambda f: f.replace("TOPO", f["TOPO"].raw[:-1]), TOPOLOGY)
simple(2005, "topology_too_long", lambda f: f.replace("TOPO", f["TOPO"].raw + b"\0"), TOPOLOGY)
simple(2006, "topology_reserved_12", lambda f: f.patch("TOPO", 12, "I", 1), TOPOLOGY)
simple(2006, "topology_reserved_63", lambda f: f.patch("TOPO", 63, "B", 1), TOPOLOGY)
simple(2006, "topology_bit_of_slot_1", lambda f: f.patch("TOPO", 64, "B", 0b0011), TOPOLOGY)
simple(2006, "topology_bit_of_no_slot", lambda f: f.patch("TOPO", 64, "B", 0b10001), TOPOLOGY)
simple(2016, "topology_order_2", lambda f: f.patch("TOPO", 0, "I", 2), TOPOLOGY)
simple(2016, "topology_ranges_2", lambda f: f.patch("TOPO", 4, "I", 2), TOPOLOGY)
simple(2016, "topology_leaf_sizes_of_3_bytes", lambda f: f.patch("TOPO", 8, "I", 3), TOPOLOGY)
simple(2016, "topology_2_64_boxes", lambda f: f.patch("TOPO", 16, "2Q", 2**64 - 1, 2**64 - 1), TOPOLOGY)
simple(2016, "topology_2_62_planes", lambda f: f.patch("TOPO", 24, "Q", 2**62), TOPOLOGY)
simple(2016, "topology_two_inner_nodes", lambda f: f.patch("TOPO", 64, "B", 0b0101), TOPOLOGY)
simple(2016, "topology_root_is_leaf", lambda f: f.patch("TOPO", 64, "B", 0b0100), TOPOLOGY)


def bitmap_size(f):
    return (struct.unpack_from("<Q", f["TREE"].raw, 8)[0] + 7) // 8


def patch_parent(f, pair, distance):
    """Damages the shuffled grid, which has less than 128 pairs, so that the lowest byte is enough."""
    return f.patch("TOPO", 64 + bitmap_size(f) + pair - 1, "B", distance)


def distance_of(f, pair):
    return f["TOPO"].raw[64 + bitmap_size(f) + pair - 1]


def leaf_in_front(f, pair):
    inner = f["TOPO"].raw[64:]
    return next(i for i in range(2 * pair - 1, 1, -1) if not inner[i // 8] >> i % 8 & 1)


simple(2016, "topology_own_parent", lambda f: patch_parent(f, 5, 0), SHUFFLED)
simple(2016, "topology_parent_before_root", lambda f: patch_parent(f, 5, 11), SHUFFLED)
simple(2016, "topology_parent_is_leaf", lambda f: patch_parent(f, 12, 24 - leaf_in_front(f, 12)), SHUFFLED)
simple(2016, "topology_parent_of_two_pairs", lambda f: patch_parent(f, 2, distance_of(f, 1) + 2), SHUFFLED)
simple(3004, "topology_range_outside", lambda f: f.patch("TOPO", 4, "I", 1).replace(
    "TOPO", f["TOPO"].raw + bytes([0, 2] + 6 * [0])), TOPOLOGY)
simple(3004, "topology_range_before_first", lambda f: f.patch("TOPO", 4, "I", 1).replace(
    "TOPO", f["TOPO"].raw + bytes([1, 1] + 6 * [0])), TOPOLOGY)
simple(3005, "topology_ranges_overlap", lambda f: f.patch("TOPO", 4, "I", 1).replace(
    "TOPO", f["TOPO"].raw + bytes([0, 1] + 6 * [0])), TOPOLOGY)
simple(3004, "topology_leaf_of_65536", lambda f: f.patch("TOPO", 8, "I", 2).replace(
    "TOPO", f["TOPO"].raw + bytes([255, 0, 255, 0])), TOPOLOGY)
simple(3005, "topology_too_many_entries", lambda f: f.patch("TOPO", 8, "I", 1).replace("TOPO", f["TOPO"].raw + bytes([1, 0])), TOPOLOGY)
simple(3006, "topology_primitive", lambda f: f.patch("PRIM", 0, "I", 2), TOPOLOGY)
simple(3009, "topology_depth", lambda f: f.patch("TREE", 32, "I", 2), TOPOLOGY)

# split_triangle_topology: behind the header a bitmap, 2 firsts, 2 sizes, a bitmap of nodes 2 and 3, their sides (max x; min x and max y),
# and the planes: min x of node 3, max x of node 2, max y of node 3
simple(2016, "topology_box_count", lambda f: f.patch("TOPO", 75, "B", 0b0100), SPLIT)
simple(2016, "topology_no_side", lambda f: f.patch("TOPO", 76, "2B", 0, 0b011001), SPLIT)
simple(2016, "topology_side_6", lambda f: f.patch("TOPO", 76, "B", 0b1001000), SPLIT)
simple(2016, "topology_plane_count", lambda f: f.patch("TOPO", 76, "B", 0b011000), SPLIT)
simple(4001, "topology_nan_plane", lambda f: f.patch("TOPO", 78, "f", float("nan")), SPLIT)
simple(4003, "topology_triangle_outside", lambda f: f.patch("TOPO", 82, "f", 0.5), SPLIT)


@case(3008, "topology_depth_97", TOPOLOGY)
def topology_too_deep(f):
    # Each left child is a leaf, each right one inner, but for the last.
    pairs = 98
    inner = [i == 0 or i > 1 and i % 2 == 1 and i < 2 * pairs - 2 for i in range(2 * pairs)]
    bitmap = bytes(sum(bit << k for k, bit in enumerate(inner[i:i + 8])) for i in range(0, len(inner), 8))
    f.replace("VERT", struct.pack("<3f", 1, 1, 1)).replace("TRIS", bytes(12 * pairs)).patch("GEOM", 0, "I", pairs)
    f.patch("SCEN", 0, "2Q", 1, pairs).patch("TREE", 8, "2Q", 2 * pairs, pairs).patch("TREE", 32, "I", 96)
    f.replace("PRIM", struct.pack(f"<{pairs}I", *range(pairs))).replace("TOPO", f["TOPO"].raw[:64] + bitmap)


simple(4006, "topology_vertex_index", lambda f: f.patch("TRIS", 8, "I", 4), TOPOLOGY)
