"""The two-level form: two-level.md."""
import math
import struct

from aabb import join_aabb
from boxes import check_root
from clauses import reject_if
from mvh import mvh_node
from quantized import quantized_nodes, quantized_trees
from ssh import ssh_node


def insets_of(root, box):
    own = [box[i] - root[i] if i < 3 else root[i] - box[i] for i in range(6)]
    for i in range(6):
        while (root[i] + own[i] > box[i]) if i < 3 else (root[i] - own[i] < box[i]):
            own[i] = math.nextafter(own[i], -math.inf)
    return own


def read_levels(chunks, slots, references, scene):
    """The top level's nodes, the roots of BLASes as nodes (those of its leaves, or, with instances, of the meshes), the nodes below
    them, PRIM, and ENTR."""
    raw = chunks.expect("FORM", 64)
    tlas_form, blas_form, blas_size, leaf_size, tlas_slots, blases, *root = struct.unpack_from("<4s4s2I2Q6f", raw)
    quantized, runs = tlas_form == b"quan", blas_form == b"mvh "
    has_bits = b"quan" in (tlas_form, blas_form)
    bits, = struct.unpack_from("<I", raw, 56)
    reject_if((leaf_size != 0 and not runs) or any(raw[60:]) or (not has_bits and bits) or (not quantized and any(raw[32:56])), 2006, "FORM: reserved")
    reject_if(not (2 <= tlas_slots <= slots and tlas_slots % 2 == 0 and blases == tlas_slots // 2
                   and ("placed" in scene or blases <= references) and 1 <= blas_size <= 65535), 2011, "FORM: counts")
    reject_if(tlas_form not in (b"aabb", b"quan") or blas_form not in (b"aabb", b"ssh ", b"mvh ", b"quan"), 2010, "form of a level")
    reject_if(blas_form == b"ssh " and references > 2**25, 2011, "references")
    reject_if((has_bits or runs) and references > 2**29, 2011, "references")
    reject_if(has_bits and not 5 <= bits <= 8, 2019, "bits")
    reject_if(runs and not 1 <= leaf_size <= 16, 2019, "leafSize")
    slots -= tlas_slots
    base, trees, entries = tlas_slots, blases, None
    if "placed" in scene:
        base, trees = 0, len(scene["runs"])
        reject_if(blases != len(scene["placed"]), 2020, "leaves of the top level")
        reject_if(runs and references != scene["triangles"], 2011, "references")
        entries = chunks.expect("ENTR", 4 * blases)
        reject_if(any(e >= blases for e, in struct.iter_unpack("<I", entries)), 3006, "ENTR")
    top_has_runs = runs and entries is None
    if quantized:
        check_root(root)
        reject_if(tlas_slots == 2 and top_has_runs and references > 128, 2011, "a root that is a leaf")
        nodes, insets = quantized_nodes(chunks.expect("TLAS", 8 * tlas_slots - 16), root, bits, references if top_has_runs else blases)
    else:
        raw = chunks.expect("TLAS", 32 * tlas_slots)
        reject_if(any(raw[32:64]), 3001, "slot 1")
        nodes = list(struct.iter_unpack("<6f2I", raw))
    leaves = [i for i, node in enumerate(nodes) if node[7] != 0]
    for i in leaves:
        first, count = nodes[i][6:]
        reject_if(first + count > references if top_has_runs else count != 1 or first >= blases, 3004, f"leaf {i}")
    for i, node in enumerate(nodes):
        if i != 1 and node[7] == 0:
            join_aabb(node, i, tlas_slots, 0)
    # Where BLASes have their roots: the box, the one that insets are measured from, and the insets; and what names the BLAS.
    if entries is None:
        frame = nodes[0][:6]
        if not quantized:
            insets = {i: insets_of(frame, nodes[i][:6]) for i in leaves if all(map(math.isfinite, (*frame, *nodes[i][:6])))}
        places = [(nodes[i][:6], frame, insets.get(i, (0.0,) * 6), nodes[i][6:]) for i in leaves]
    elif runs:
        places = [(tuple(box), box, (0.0,) * 6, run) for box, run in zip(scene["mesh_boxes"], scene["runs"])]
    else:
        places = [(tuple(box), box, (0.0,) * 6, (k, 1)) for k, box in enumerate(scene["mesh_boxes"])]
    if runs:
        reject_if(sum(2 * (-(-count // leaf_size) - 1) for *_, (_, count) in places) != slots, 2011, "slots of the BLASes")
        codes, used, whole, below = chunks.expect("BLAS", -(-references // leaf_size)), set(), [], []
        for box, frame, own, run in places:
            whole.append(mvh_node(box, box, own, run, leaf_size, codes, frame, used, below, base))
        reject_if(any(code for at, code in enumerate(codes) if at not in used), 2006, "a byte that serves no node")
    elif blas_form == b"quan":
        roots = list(struct.iter_unpack("<2I", chunks.expect("ROOT", 8 * trees)))
        for word, more in roots:
            reject_if(more % 8 or more > (0xFF if word >> 31 else 0), 3010, "a root's more")
            reject_if(not word >> 31 and word >= slots // 2, 3002, "a root's record")
        whole, below, _ = quantized_trees(chunks.expect("BLAS", 8 * slots), roots, places, bits, base)
    elif blas_form == b"aabb":
        roots = list(struct.iter_unpack("<2I", chunks.expect("ROOT", 8 * trees)))
        below = [join_aabb(n, i, slots, base) for i, n in enumerate(struct.iter_unpack("<6f2I", chunks.expect("BLAS", 32 * slots)))]
        whole = [join_aabb((*box, *roots[k]), -1, slots, base) for box, *_, (k, _) in places]
    else:
        roots = struct.unpack(f"<{trees}I", chunks.expect("ROOT", 4 * trees))
        inherited, below = {}, []
        whole = [ssh_node(-1, None, roots[k], box, slots, base, inherited) for box, *_, (k, _) in places]
        for i, (plane, word) in enumerate(struct.iter_unpack("<fI", chunks.expect("BLAS", 8 * slots))):
            reject_if(i not in inherited, 3003, f"node {i} of the bottom level")
            below.append(ssh_node(i, plane, word, inherited[i], slots, base, inherited))
    return nodes, whole, below, chunks.expect("PRIM", 4 * references), entries


def read_two_level(chunks, slots, references):
    nodes, roots, below, primitives, _ = read_levels(chunks, slots, references, {})
    leaves = [i for i, node in enumerate(nodes) if node[7] != 0]
    for i, root in zip(leaves, roots):
        nodes[i] = root
    return nodes + below, primitives
