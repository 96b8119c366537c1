"""How a tree in the aabb form lies in clusters: clusters.md."""
import struct

from clauses import reject_if

LINES = (1, 2, 4, 8, 16, 32, 64)


def check_clusters(nodes, raw):
    """CLUS beside a tree that is right."""
    reject_if(len(raw) < 20 or len(raw) % 4 != 0, 2005, "CLUS")
    bits, line_slots, *words = struct.unpack(f"<{len(raw) // 4}I", raw)
    reject_if(words.pop(0) != 0 or words.pop(0) != 0, 2006, "CLUS: reserved")
    reject_if(not 2 <= bits <= 10 or line_slots not in LINES, 3011, "CLUS: parameters")
    parents = {node[6] // 2 - 1: i // 2 - 1 for i, node in enumerate(nodes) if i != 1 and node[7] == 0}  # of the root's children: -1
    records, glue = {}, {}
    for slot, word in enumerate(words):
        if word != 2**32 - 1:
            found, pair = (glue if word >> 31 else records), word & (2**31 - 1)
            reject_if(pair not in parents or pair in found, 3011, f"slot {slot}")
            found[pair] = slot
    reject_if(len(records) != len(parents) or records.get(0) != 0 or 0 in glue, 3011, "CLUS: pairs")
    cluster_of, cluster = [], 0
    for slot, word in enumerate(words):
        if word in records and (word in glue or word == 0):
            cluster = slot
            reject_if(slot % line_slots != 0, 3011, f"slot {slot}")
        reject_if(word != 2**32 - 1 and slot - cluster >= 2**bits, 3011, f"slot {slot}")
        cluster_of.append(cluster)
    for pair, parent in parents.items():
        if parent >= 0:
            named = glue.get(pair, records[pair])
            reject_if(cluster_of[named] != cluster_of[records[parent]] or not records[parent] < named <= records[pair], 3011, f"pair {pair}")
