"""Malformed files of clusters next to the aabb form: clusters.md."""
import struct

from damage import Chunk, case, set_field, simple

# Clusters beside the aabb form. two_triangles_clusters: one slot; the grid has clusters of at most 8 slots, in lines of 2
CLUSTERS, CLUSTER_GRID = "two_triangles_clusters", "grid_clusters"


def cluster_words(f):
    return list(struct.unpack(f"<{len(f['CLUS'].raw) // 4 - 4}I", f["CLUS"].raw[16:]))


def put_cluster_words(f, words):
    return f.replace("CLUS", f["CLUS"].raw[:16] + struct.pack(f"<{len(words)}I", *words))


simple(2002, "clusters_of_quantized", lambda f: f.chunks.append(Chunk(b"CLUS", 0, struct.pack("<5I", 8, 8, 0, 0, 0))), "two_triangles_quantized")
simple(2004, "clusters_flags", lambda f: set_field(f["CLUS"], flags=1), CLUSTERS)
simple(2005, "clusters_no_slots", lambda f: f.replace("CLUS", f["CLUS"].raw[:16]), CLUSTERS)
simple(2005, "clusters_half_a_slot", lambda f: f.replace("CLUS", f["CLUS"].raw + bytes(2)), CLUSTERS)
simple(2006, "clusters_reserved", lambda f: f.patch("CLUS", 12, "I", 1), CLUSTERS)
simple(3011, "clusters_bits_1", lambda f: f.patch("CLUS", 0, "I", 1), CLUSTERS)
simple(3011, "clusters_bits_11", lambda f: f.patch("CLUS", 0, "I", 11), CLUSTERS)
simple(3011, "clusters_lines_of_0", lambda f: f.patch("CLUS", 4, "I", 0), CLUSTERS)
simple(3011, "clusters_no_such_pair", lambda f: f.patch("CLUS", 16, "I", 1), CLUSTERS)
simple(3011, "clusters_pair_missing", lambda f: f.patch("CLUS", 16, "I", 2**32 - 1), CLUSTERS)
simple(3011, "clusters_pair_twice", lambda f: put_cluster_words(f, [0, 0]), CLUSTERS)
simple(3011, "clusters_root_not_first", lambda f: put_cluster_words(f, [2**32 - 1, 0]), CLUSTERS)
simple(3011, "clusters_glue_to_the_root", lambda f: put_cluster_words(f, [0, 2**31]), CLUSTERS)
simple(3011, "clusters_out_of_reach", lambda f: f.patch("CLUS", 0, "I", 2), CLUSTER_GRID)
simple(3011, "clusters_within_a_line", lambda f: f.patch("CLUS", 4, "I", 64), CLUSTER_GRID)


@case(3011, "clusters_glue_elsewhere", CLUSTER_GRID)
def glue_elsewhere(f):
    # The first glue moves behind all slots, out of its cluster.
    words = cluster_words(f)
    at = next(i for i, word in enumerate(words) if 2**31 <= word < 2**32 - 1)
    words.append(words[at])
    words[at] = 2**32 - 1
    put_cluster_words(f, words)


@case(3011, "clusters_glue_missing", CLUSTER_GRID)
def glue_missing(f):
    # The first glue's cluster becomes a part of the one before it.
    put_cluster_words(f, [2**32 - 1 if 2**31 <= word else word for word in cluster_words(f)])


@case(3011, "clusters_child_first", CLUSTER_GRID)
def child_first(f):
    # Two records of the first cluster, parent and child, change places.
    words = cluster_words(f)
    at = [i for i, word in enumerate(words) if 0 < word < 2**31][:2]
    words[at[0]], words[at[1]] = words[at[1]], words[at[0]]
    put_cluster_words(f, words)
