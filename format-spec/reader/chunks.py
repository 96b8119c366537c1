"""The chunks that this reader knows, their order, the scene, and provenance: chunks.md."""
import math
import struct

from clauses import Rejected, reject_if
from container import CRITICAL
from instances import read_instances

# Known types in file order: flags.
KNOWN = {"SCEN": 7, "VERT": 7, "TRIS": 7, "DRCO": 7, "GEOM": 7, "SRCP": 7, "MESH": 7, "INST": 7, "TREE": 1,
         "ENTR": 1, "FORM": 1, "NODE": 1, "TLAS": 1, "ROOT": 1, "BLAS": 1, "LAST": 1, "PRIM": 1, "TOPO": 1, "CLUS": 0, "VISI": 0, "PROV": 6}


class Sequence:
    """Known chunks in the order of chunks.md."""

    def __init__(self, chunks):
        self.known, seen = [], set()
        for chunk in chunks:
            if chunk.type not in KNOWN:
                reject_if(chunk.flags & CRITICAL, 2001, f"unknown critical chunk {chunk.type}")
                continue
            reject_if(chunk.flags != KNOWN[chunk.type], 2004, f"flags of {chunk.type}")
            reject_if(chunk.type in seen, 2003, f"{chunk.type} twice")
            seen.add(chunk.type)
            self.known.append(chunk)

    def expect(self, kind, size=None):
        found = self.known.pop(0) if self.known else None
        reject_if(found is None or found.type != kind, 2002, f"{kind} should be here")
        reject_if(size is not None and found.raw_size != size, 2005, f"size of {kind}")
        return found.raw

    def next_is(self, kind):
        return bool(self.known) and self.known[0].type == kind


def check_text(data):
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise Rejected(2014, "text is not UTF-8") from error


def read_scene(chunks):
    raw = chunks.expect("SCEN", 64)
    vertices, triangles, geometries, name_bytes, encoding, flags, meshes, instances = struct.unpack_from("<4Q4I", raw)
    reject_if(any(raw[48:]) or flags > 3 or (flags < 2 and meshes + instances > 0), 2006, "SCEN: reserved")
    reject_if(not (1 <= vertices < 2**32 and 1 <= triangles < 2**31 and 1 <= geometries < 2**32 and name_bytes < 2**32), 2007,
              "SCEN: counts")
    if flags & 2:
        reject_if(not (1 <= meshes <= geometries and 1 <= instances < 2**31), 2007, "SCEN: counts of instances")
        reject_if(encoding == 1, 2020, "instances with Draco")
    reject_if(encoding > 1, 2008, "geometry encoding")
    points, corners = None, None
    if encoding == 0:
        points = list(struct.iter_unpack("<3f", chunks.expect("VERT", 12 * vertices)))
        for p in points:
            reject_if(not all(map(math.isfinite, p)), 4004, "vertex")
            reject_if(any(c == 0 and math.copysign(1, c) < 0 for c in p), 4005, "-0")
        corners = list(struct.iter_unpack("<3I", chunks.expect("TRIS", 12 * triangles)))
        reject_if(any(i >= vertices for t in corners for i in t), 4006, "vertex index")
    else:
        chunks.expect("DRCO")
    raw = chunks.expect("GEOM", 8 * geometries + name_bytes)
    table = list(struct.iter_unpack("<2I", raw[:8 * geometries]))
    reject_if(sum(c for c, _ in table) != triangles or sum(n for _, n in table) != name_bytes, 2009, "geometry table")
    names, at = [], 8 * geometries
    for _, length in table:
        names.append(check_text(raw[at:at + length]))
        at += length
    if flags & 1:
        chunks.expect("SRCP", 4 * triangles)
    boxes = None
    if points is not None:
        boxes = [[f(points[i][axis] for i in t) for f in (min, max) for axis in range(3)] for t in corners]
    scene = {"vertices": vertices, "triangles": triangles, "geometries": len(names), "boxes": boxes}
    if flags & 2:
        read_instances(chunks, scene, [count for count, _ in table], meshes, instances)
    return scene


def read_provenance(raw):
    at, texts = 8, []
    reject_if(len(raw) < 8, 2013, "PROV: cut")
    count, reserved = struct.unpack_from("<2I", raw)
    reject_if(reserved != 0, 2006, "PROV: reserved")
    reject_if(12 * count > len(raw) - 8, 2013, "PROV: entries")
    for _ in range(3 * count):
        reject_if(at + 4 > len(raw), 2013, "PROV: cut")
        length, = struct.unpack_from("<I", raw, at)
        reject_if(at + 4 + length > len(raw), 2013, "PROV: cut")
        texts.append(check_text(raw[at + 4:at + 4 + length]))
        at += 4 + length
    reject_if(at != len(raw), 2013, "PROV: bytes behind the last entry")
    return texts[::3]
