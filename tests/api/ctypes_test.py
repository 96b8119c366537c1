#!/usr/bin/env python3
"""Builds, saves, opens and traces through libbvhio.so by its C ABI alone, with Python's standard library: what any other language
can do, too. Structs are written out here a second time, so a change of the ABI is found.
Usage: ctypes_test.py LIBBVHIO.so. Without a library it says so and ends with 77, which ctest counts as skipped."""

import ctypes
import math
import os
import struct
import sys
import tempfile
from ctypes import POINTER, Structure, byref, c_char_p, c_double, c_float, c_int, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p


class SceneArrays(Structure):
    _fields_ = [("vertices", c_void_p), ("vertexCount", c_uint64), ("vertexStride", c_uint64), ("indices", c_void_p),
                ("triangleCount", c_uint64), ("parts", c_void_p), ("partCount", c_uint64), ("sourceIds", c_void_p),
                ("meshes", c_void_p), ("meshCount", c_uint64), ("placements", c_void_p), ("placementCount", c_uint64)]


PROGRESS = ctypes.CFUNCTYPE(c_int, c_void_p, c_uint64, c_uint64)


class Context(Structure):
    _fields_ = [("threads", c_uint32), ("progress", PROGRESS), ("progressUser", c_void_p), ("program", c_char_p),
                ("programVersion", c_char_p)]


class Info(Structure):
    _fields_ = [("vertexCount", c_uint64), ("triangleCount", c_uint64), ("geometryCount", c_uint64),
                ("meshCount", c_uint64), ("instanceCount", c_uint64), ("primitiveCount", c_uint64),
                ("treeCount", c_uint64), ("nodeBytes", c_uint64), ("contentHash", c_uint64), ("form", c_char_p),
                ("traversalCost", c_float), ("intersectionCost", c_float), ("chunkCount", c_uint32),
                ("historyCount", c_uint32)]


class Node(Structure):
    _fields_ = [("min", c_float * 3), ("max", c_float * 3), ("first", c_uint32), ("count", c_uint32)]


class Tree(Structure):
    _fields_ = [("nodes", POINTER(Node)), ("nodeCount", c_uint64), ("primitives", POINTER(c_uint32)),
                ("primitiveCount", c_uint64)]


class Ray(Structure):
    _fields_ = [("origin", c_float * 3), ("tMin", c_float), ("direction", c_float * 3), ("tMax", c_float)]


class Hit(Structure):
    _fields_ = [("t", c_float), ("u", c_float), ("v", c_float), ("primitive", c_uint32), ("geometry", c_uint32),
                ("instance", c_uint32)]


class History(Structure):
    _fields_ = [("program", c_char_p), ("version", c_char_p), ("options", c_char_p)]


OK, USAGE, INVALID, CANCELLED = 0, 1, 3, 6


def load(path):
    library = ctypes.CDLL(path)
    for name in ("bvhioLastError", "bvhioVersionText", "bvhioMethodName"):
        getattr(library, name).restype = c_char_p
    library.bvhioMethodName.argtypes = [c_int, c_uint64]
    library.bvhioMethodCount.restype = c_uint64
    library.bvhioTraceClosest.argtypes = [c_void_p, POINTER(Ray), c_size_t, POINTER(Hit), POINTER(c_uint32), c_uint32]
    library.bvhioTraceAny.argtypes = [c_void_p, POINTER(Ray), c_size_t, POINTER(c_uint8), c_uint32]
    library.bvhioOpenFile.argtypes = [c_char_p, c_uint32, c_void_p, c_void_p]
    for name in ("bvhioClose", "bvhioDestroyScene", "bvhioDestroyTracer", "bvhioGetInfo", "bvhioGetCost"):
        getattr(library, name).argtypes = [c_void_p] if "Get" not in name else [c_void_p, c_void_p]
    for name in ("bvhioClose", "bvhioDestroyScene", "bvhioDestroyTracer"):
        getattr(library, name).restype = None
    library.bvhioBuild.argtypes = library.bvhioRestructure.argtypes = [c_void_p] * 4
    library.bvhioGetTree.argtypes = library.bvhioGetHistory.argtypes = [c_void_p, c_uint64, c_void_p]
    library.bvhioSaveFile.argtypes = [c_void_p, c_char_p, c_void_p]
    library.bvhioCreateScene.argtypes = [c_void_p, c_void_p]
    library.bvhioCreateTracer.argtypes = [c_void_p, c_uint32, c_void_p, c_void_p]
    return library


def main():
    if len(sys.argv) < 2 or not sys.argv[1]:
        print("skipped: there is no shared library in this build")
        return 77
    b = load(sys.argv[1])

    def check(status, expected=OK):
        assert status == expected, f"status {status}: {b.bvhioLastError().decode()}"

    assert [ctypes.sizeof(s) for s in (Node, Ray, Hit)] == [32, 32, 24]
    print("libbvhio", b.bvhioVersionText().decode())
    assert b.bvhioMethodName(3, 0) == b"aabb"

    # A square of two triangles at z = 1.
    corners = struct.pack("12f", 0, 0, 1, 4, 0, 1, 0, 4, 1, 4, 4, 1)
    indices = (c_uint32 * 6)(0, 1, 2, 1, 3, 2)
    arrays = SceneArrays(vertices=ctypes.cast(c_char_p(corners), c_void_p), vertexCount=4,
                         indices=ctypes.cast(indices, c_void_p), triangleCount=2)
    scene = c_void_p()
    check(b.bvhioCreateScene(byref(arrays), byref(scene)))
    arrays.vertexCount = 3
    refused = c_void_p(1)
    check(b.bvhioCreateScene(byref(arrays), byref(refused)), INVALID)
    assert refused.value is None and b"vertex index" in b.bvhioLastError()

    options = (c_char_p * 3)(b"builder=sweep", b"max-leaf-size=1", None)
    calls = []
    context = Context(program=b"ctypes_test.py", programVersion=b"1",
                      progress=PROGRESS(lambda user, done, total: calls.append((done, total)) or 0))
    built = c_void_p()
    check(b.bvhioBuild(scene, options, byref(context), byref(built)))
    assert calls
    context.progress = PROGRESS(lambda user, done, total: 1)
    nothing = c_void_p()
    check(b.bvhioBuild(scene, options, byref(context), byref(nothing)), CANCELLED)
    check(b.bvhioBuild(scene, (c_char_p * 2)(b"builder=best", None), None, byref(nothing)), USAGE)
    assert b"binned" in b.bvhioLastError()

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "square.bvhx").encode()
        check(b.bvhioSaveFile(built, path, None))
        opened = c_void_p()
        check(b.bvhioOpenFile(path, 0, None, byref(opened)))

    info, tree, history, cost = Info(), Tree(), History(), c_double()
    check(b.bvhioGetInfo(opened, byref(info)))
    assert (info.triangleCount, info.vertexCount, info.form, info.treeCount) == (2, 4, b"aabb", 1)
    check(b.bvhioGetTree(opened, 0, byref(tree)))
    assert tree.nodeCount == 4 and sorted(tree.primitives[i] for i in range(tree.primitiveCount)) == [0, 1]
    assert list(tree.nodes[0].max) == [4, 4, 1] and tree.nodes[0].count == 0
    check(b.bvhioGetHistory(opened, 0, byref(history)))
    assert history.program == b"ctypes_test.py" and b'"builder":"sweep"' in history.options
    check(b.bvhioGetCost(opened, byref(cost)))
    assert cost.value > 0

    tracer = c_void_p()
    check(b.bvhioCreateTracer(opened, 0, None, byref(tracer)))
    b.bvhioClose(opened)
    places = [(1, 1), (3, 3), (9, 9)]
    rays = (Ray * 3)(*(Ray((x, y, 5), 0, (0, 0, -1), math.inf) for x, y in places))
    hits, primitives, occluded = (Hit * 3)(), (c_uint32 * 3)(), (c_uint8 * 3)()
    check(b.bvhioTraceClosest(tracer, rays, 3, hits, primitives, 0))
    check(b.bvhioTraceAny(tracer, rays, 3, occluded, 0))
    assert [h.t for h in hits] == [4, 4, math.inf] and list(primitives) == [0, 1, 0xFFFFFFFF]
    assert list(occluded) == [1, 1, 0]
    b.bvhioDestroyTracer(tracer)
    b.bvhioClose(built)
    b.bvhioDestroyScene(scene)
    print("opened, traced, built and saved through", sys.argv[1])
    return 0


if __name__ == "__main__":
    sys.exit(main())
