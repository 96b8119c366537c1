#!/usr/bin/python3
"""A second reader of .bvhx files, written from the pages of format-spec alone; it shares no code with the library.

Usage: bvhx_reader.py FILE...        "-" is standard input
Prints a summary of each file, or the clause by which it must be rejected. Exit: 0 all read, 2 a file cannot be opened,
3 a file is invalid, 5 a file is unsupported (of the last file that was not read). Draco geometry is not decoded: the checks
that need its vertices are left out, and the summary says so.

Needs the Python modules xxhash and zstandard (Debian: python3-xxhash, python3-zstandard). The modules beside it bear the
names of the pages that they read by.
"""
import math
import struct
import sys

# The modules beside this one leave nothing there.
sys.dont_write_bytecode = True
from aabb import read_aabb  # noqa: E402
from chunks import Sequence, read_provenance, read_scene  # noqa: E402
from clauses import Rejected, reject_if  # noqa: E402
from clusters import check_clusters  # noqa: E402
from container import read_container  # noqa: E402
from instances import check_instanced  # noqa: E402
from mvh import read_mvh  # noqa: E402
from quantized import read_quantized  # noqa: E402
from quantized_short import read_quantized_short  # noqa: E402
from ssh import read_ssh  # noqa: E402
from topology import read_topology  # noqa: E402
from tree import check_tree  # noqa: E402
from two_level import read_two_level  # noqa: E402
from visits import check_visits  # noqa: E402

FORMS = {b"aabb": read_aabb, b"quan": read_quantized, b"qush": read_quantized_short, b"ssh ": read_ssh, b"mvh ": read_mvh, b"two ": read_two_level}


def read_tree(chunks, scene):
    raw = chunks.expect("TREE", 64)
    form, reserved, slots, references, traversal, intersection, depth = struct.unpack_from("<4sIQQ2fI", raw)
    reject_if(reserved != 0 or any(raw[36:]), 2006, "TREE: reserved")
    reject_if(form not in FORMS, 2010, f"form {form}")
    reject_if(not (scene["triangles"] <= references < 2**32 and 2 <= slots <= 2 * (references + len(scene.get("placed", ()))) and slots < 2**32
                   and slots % 2 == 0 and depth <= 96), 2011, "TREE: counts")
    for cost in (traversal, intersection):
        reject_if(not math.isfinite(cost) or math.copysign(1, cost) < 0, 2012, "SAH cost")
    reject_if(form == b"mvh " and references != scene["triangles"], 2011, "TREE: references")
    summary = {"form": form.decode().strip(), "nodes": slots - 1, "references": references, "depth": depth}
    if "placed" in scene:
        reject_if(form != b"two ", 2020, "form of an instanced scene")
        check_instanced(chunks, slots, references, depth, scene)
        return summary
    if form == b"aabb" and chunks.next_is("PRIM"):
        nodes, primitives = read_topology(chunks, slots, references, scene["boxes"])
    else:
        nodes, primitives = FORMS[form](chunks, slots, references)
    check_tree(nodes, primitives, slots, references, depth, scene)
    if form == b"aabb" and chunks.next_is("CLUS"):
        check_clusters(nodes, chunks.expect("CLUS"))
    if form == b"aabb" and chunks.next_is("VISI"):
        summary["rays"] = check_visits(struct.unpack(f"<{slots // 2}I", chunks.expect("VISI", 2 * slots)), nodes)
    return summary


def read(data):
    """The summary of a file as a dict; raises Rejected."""
    all_chunks, content_hash = read_container(data)
    chunks = Sequence(all_chunks)
    scene = read_scene(chunks)
    tree = read_tree(chunks, scene)
    tools = read_provenance(chunks.expect("PROV")) if chunks.next_is("PROV") else []
    reject_if(bool(chunks.known), 2002, "END should be here")
    geometry = "not decoded" if scene.pop("boxes") is None else "checked"
    if "placed" in scene:
        scene["meshes"], scene["instances"] = len(scene.pop("runs")), len(scene.pop("placed"))
        del scene["mesh_boxes"]
    return {**scene, **tree, "geometry": geometry, "tools": " ".join(tools), "chunks": len(all_chunks),
            "content_hash": f"{content_hash:016x}"}


def main(paths):
    if not paths or paths[0] in ("-h", "--help"):
        print(__doc__)
        return 0 if paths else 1
    status = 0
    for path in paths:
        try:
            with (sys.stdin.buffer if path == "-" else open(path, "rb")) as file:
                data = file.read()
        except OSError as error:
            print(f"{path}: {error.strerror}")
            status = 2
            continue
        try:
            print(f"{path}: valid 0 " + " ".join(f"{k}={v}" for k, v in read(data).items()))
        except Rejected as rejected:
            print(f"{path}: {rejected.kind} {rejected.clause} {rejected}")
            status = 5 if rejected.kind == "unsupported" else 3
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
