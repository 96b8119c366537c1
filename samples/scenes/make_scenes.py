#!/usr/bin/env python3
"""Writes the sample scenes into the folder of this script. Needs only Python, and writes the same files every time."""
import json
import math
import os
import struct

HERE = os.path.dirname(os.path.abspath(__file__))


class Mesh:
    """Indexed triangles, y up. Faces are counter-clockwise seen from outside."""

    def __init__(self):
        self.vertices = []
        self.triangles = []

    def vertex(self, x, y, z):
        # Five decimals: the last digits of sin and cos differ between machines.
        self.vertices.append(tuple(round(c, 5) + 0.0 for c in (x, y, z)))
        return len(self.vertices) - 1

    def triangle(self, a, b, c):
        self.triangles.append((a, b, c))

    def quad(self, a, b, c, d):
        self.triangle(a, b, c)
        self.triangle(a, c, d)


def box(width, height, depth):
    """A box that stands on y = 0, centred in x and z."""
    mesh = Mesh()
    x, z = width / 2, depth / 2
    for y in (0, height):
        for cx, cz in ((-x, -z), (x, -z), (x, z), (-x, z)):
            mesh.vertex(cx, y, cz)
    for face in ((0, 1, 2, 3), (7, 6, 5, 4), (4, 5, 1, 0), (5, 6, 2, 1), (6, 7, 3, 2), (7, 4, 0, 3)):
        mesh.quad(*face)
    return mesh


def lathe(profile, segments, flutes=0, depth=0.0, fluted=()):
    """Rotates a profile of (radius, y), from bottom to top, about y. Rows in `fluted` get that many grooves."""
    mesh = Mesh()
    rings = []
    for row, (radius, y) in enumerate(profile):
        if radius == 0:
            rings.append([mesh.vertex(0, y, 0)] * segments)
            continue
        ring = []
        for s in range(segments):
            angle = 2 * math.pi * s / segments
            r = radius - (depth * abs(math.sin(flutes * angle / 2)) if row in fluted else 0)
            ring.append(mesh.vertex(r * math.cos(angle), y, r * math.sin(angle)))
        rings.append(ring)
    for lower, upper in zip(rings, rings[1:]):
        for s in range(segments):
            t = (s + 1) % segments
            if upper[s] != upper[t]:
                mesh.triangle(lower[s], upper[s], upper[t])
            if lower[s] != lower[t]:
                mesh.triangle(lower[s], upper[t], lower[t])
    return mesh


def sphere(radius, rows, segments):
    rings = [(radius * math.sin(math.pi * i / rows), -radius * math.cos(math.pi * i / rows)) for i in range(rows + 1)]
    rings[0], rings[-1] = (0, -radius), (0, radius)
    return lathe(rings, segments)


def arch(width, height, depth, radius, segments):
    """A block from y = 0 to height with a half-round opening at its foot."""
    mesh = Mesh()
    x, z = width / 2, depth / 2
    inner, outer = [], []
    for i in range(segments + 1):
        angle = math.pi * i / segments
        c, s = math.cos(angle), math.sin(angle)
        reach = min(x / abs(c) if abs(c) > 1e-9 else 1e9, height / s if s > 1e-9 else 1e9)
        inner.append((radius * c, radius * s))
        outer.append((reach * c, reach * s))
    rows = [[mesh.vertex(px, py, side) for px, py in path] for path in (inner, outer) for side in (-z, z)]
    inner_back, inner_front, outer_back, outer_front = rows
    for i in range(segments):
        mesh.quad(inner_front[i], outer_front[i], outer_front[i + 1], inner_front[i + 1])
        mesh.quad(inner_back[i + 1], outer_back[i + 1], outer_back[i], inner_back[i])
        mesh.quad(inner_back[i], inner_front[i], inner_front[i + 1], inner_back[i + 1])
        mesh.quad(outer_back[i + 1], outer_front[i + 1], outer_front[i], outer_back[i])
    return mesh


def roof_tile(length, radius, segments):
    """A half-round tile along z, open below, with a thickness."""
    mesh = Mesh()
    rows = [[mesh.vertex(r * math.cos(math.pi * i / segments), r * math.sin(math.pi * i / segments), z)
             for i in range(segments + 1)] for r in (radius, radius * 0.85) for z in (0, length)]
    for i in range(segments):
        mesh.quad(rows[0][i], rows[0][i + 1], rows[1][i + 1], rows[1][i])
        mesh.quad(rows[3][i], rows[3][i + 1], rows[2][i + 1], rows[2][i])
        mesh.quad(rows[1][i], rows[1][i + 1], rows[3][i + 1], rows[3][i])
    return mesh


def torus(radius, thickness, around, across):
    mesh = Mesh()
    for i in range(around):
        a = 2 * math.pi * i / around
        for j in range(across):
            b = 2 * math.pi * j / across
            r = radius + thickness * math.cos(b)
            mesh.vertex(r * math.cos(a), thickness * math.sin(b), r * math.sin(a))
    for i in range(around):
        for j in range(across):
            k, l = (i + 1) % around, (j + 1) % across
            mesh.quad(i * across + j, i * across + l, k * across + l, k * across + j)
    return mesh


def courtyard():
    """Returns the meshes and the tree of nodes of the courtyard: {name, mesh, translation, rotation, scale, children}."""
    shaft = [(0.24, 0.30 + 2.1 * i / 6) for i in range(7)]
    shaft = [(r * (1 - 0.18 * (i / 6) ** 2), y) for i, (r, y) in enumerate(shaft)]
    column = [(0, 0), (0.36, 0), (0.36, 0.1), (0.33, 0.14), (0.35, 0.19), (0.33, 0.24), (0.27, 0.27)] + shaft + \
             [(0.23, 2.45), (0.26, 2.5), (0.22, 2.54), (0.30, 2.66), (0.36, 2.72), (0.36, 2.8), (0, 2.8)]
    basin = [(0, 0), (1.5, 0), (1.62, 0.1), (1.62, 0.5), (1.72, 0.55), (1.72, 0.65), (1.5, 0.65), (1.45, 0.3), (0.3, 0.25),
             (0.18, 0.4), (0.14, 0.9), (0.2, 1.3), (0.5, 1.45), (0.85, 1.65), (0.9, 1.72), (0.8, 1.72), (0.3, 1.6), (0.1, 1.6),
             (0.08, 1.9), (0, 1.9)]
    step = [(0, 0), (1, 0), (1, 0.85), (0.985, 1), (0, 1)]
    urn = [(0, 0), (0.3, 0), (0.3, 0.08), (0.12, 0.16), (0.12, 0.26), (0.36, 0.5), (0.42, 0.75), (0.3, 0.95), (0.36, 1.05),
           (0.3, 1.05), (0.24, 0.95), (0, 0.9)]
    meshes = {
        "column": lathe(column, 24, 12, 0.035, range(8, 13)),
        "arch": arch(2, 1.5, 0.5, 0.72, 24),
        "cornice": box(2, 0.15, 0.7),
        "wall": box(17.6, 5, 0.4),
        "floor tile": box(0.96, 0.08, 0.96),
        "roof tile": roof_tile(1.0, 0.15, 4),
        "rafters": box(17.6, 0.08, 3.4),
        "round step": lathe(step, 64),
        "fountain": lathe(basin, 48),
        "sphere": sphere(0.35, 16, 32),
        "urn": lathe(urn, 32),
        "ground": box(24, 0.2, 24),
    }

    def node(mesh, x=0, y=0, z=0, **more):
        return dict(name=mesh, mesh=mesh, translation=[x, y, z], **more)

    nodes = [node("ground", 0, -0.2, 0)]
    nodes += [node("floor tile", x - 8, 0, z - 8) for x in range(17) for z in range(17)]
    nodes += [node("round step", y=0.08 + 0.15 * i, scale=[r, 0.15, r]) for i, r in enumerate((3.2, 2.8, 2.4))]
    nodes += [node("fountain", y=0.53), node("sphere", y=2.7)]
    for x in (-4, 4):
        for z in (-4, 4):
            nodes += [node("round step", x, 0.08, z, scale=[0.55, 0.5, 0.55]), node("urn", x, 0.58, z),
                      node("sphere", x, 1.75, z, scale=[0.9, 0.9, 0.9])]
    for side in range(4):
        half = math.pi * side / 4
        children = [node("wall", 0, 0, -8.6)]
        for i in range(6):
            children.append(node("column", 2 * i - 6, 0.08, -6))
            children.append(node("arch", 2 * i - 5, 2.88, -6))
            children.append(node("cornice", 2 * i - 5, 4.38, -6))
        slope = math.radians(15)
        tilt = [round(math.sin(slope / 2), 9), 0, 0, round(math.cos(slope / 2), 9)]
        tiles = [node("rafters", 0, -0.12, 1.55)]
        tiles += [node("roof tile", 0.32 * i - 8.48, 0.03 * (2 - j), 1.0 * j, scale=[1, 1, 1.08]) for i in range(54) for j in range(3)]
        children.append(dict(name="roof", translation=[0, 5.4, -8.7], rotation=tilt, children=tiles))
        nodes.append(dict(name="side %d" % side, rotation=[0, round(math.sin(half), 9), 0, round(math.cos(half), 9)],
                          children=children))
    return meshes, nodes


def tuft(blades):
    """A tuft of bent blades of grass, each made of two tapering quads."""
    mesh = Mesh()
    for i in range(blades):
        angle = 2.4 * i
        c, s = math.cos(angle), math.sin(angle)
        height, lean, half = 0.3 + 0.05 * (i % 4), 0.04 + 0.03 * (i % 3), 0.012
        rows = [[mesh.vertex(c * out - s * side, y, s * out + c * side) for side in (-w, w)]
                for out, y, w in ((0.02, 0, half), (0.02 + lean, 0.6 * height, 0.8 * half), (0.02 + 3 * lean, height, 0.1 * half))]
        for low, high in zip(rows, rows[1:]):
            mesh.quad(low[0], low[1], high[1], high[0])
    return mesh


def orchard():
    """A few meshes in thousands of places: trees in a hierarchy of nodes, and grass as instances, each in a node of its own."""
    meshes = {
        "ground": box(40, 0.2, 40),
        "trunk": lathe([(0, 0), (0.3, 0), (0.16, 0.4), (0.13, 1.5), (0.2, 1.9), (0, 2.1)], 12),
        "crown": sphere(1.1, 8, 12),
        "apple": sphere(0.09, 4, 6),
        "post": box(0.12, 1.1, 0.12),
        "rail": box(3.2, 0.09, 0.05),
        "grass": tuft(9),
    }

    def turn(angle):
        return [0, round(math.sin(angle / 2), 9), 0, round(math.cos(angle / 2), 9)]

    def tree(number):
        apples = [dict(name="apple", mesh="apple", translation=[1.1 * math.cos(2.4 * i) * math.sin(0.7 + 0.2 * i),
                                                                2.6 - 0.2 * i, 1.1 * math.sin(2.4 * i) * math.sin(0.7 + 0.2 * i)])
                  for i in range(5)]
        crown = [dict(name="crown", mesh="crown", translation=[x, y, z], scale=[s, 0.8 * s, s])
                 for x, y, z, s in ((0, 2.5, 0, 1), (0.6, 2.1, 0.3, 0.7), (-0.5, 2.2, 0.4, 0.65), (0.1, 2.1, -0.6, 0.7))]
        # Every other tree is mirrored.
        size = 0.8 + 0.07 * (number * 5 % 7)
        return dict(name="tree", rotation=turn(1.3 * number), scale=[size if number % 2 else -size, size * (1 + 0.1 * (number % 3)), size],
                    children=[dict(name="trunk", mesh="trunk"), *crown, *apples])

    nodes = [dict(name="ground", mesh="ground", translation=[0, -0.2, 0])]
    for row in range(6):
        children = []
        for i in range(6):
            standing = tree(6 * row + i)
            standing["translation"] = [5.4 * i - 13.5, 0, 0.5 * (i % 2)]
            children.append(standing)
        nodes.append(dict(name="row %d" % row, translation=[0, 0, 5.4 * row - 13.5], children=children))
    for side in range(4):
        fence = [dict(name="post", mesh="post", translation=[3.2 * i - 17.6, 0, 17.6]) for i in range(11)]
        fence += [dict(name="rail", mesh="rail", translation=[3.2 * i - 16, y, 17.6]) for i in range(11) for y in (0.45, 0.9)]
        nodes.append(dict(name="fence", rotation=turn(math.pi * side / 2), children=fence))
    # Steps by two golden ratios spread points evenly over a square.
    places = []
    for i in range(900):
        x, z = 36 * (i * 0.7548776662 % 1) - 18, 36 * (i * 0.5698402910 % 1) - 18
        size = 0.7 + 0.06 * (i * 7 % 11)
        places.append(([x, 0, z], turn(2.1 * i), [size, size * (0.8 + 0.1 * (i % 5)), size]))
    nodes.append(dict(name="grass", mesh="grass", instances=places))
    return meshes, nodes


def write_glb(path, meshes, nodes):
    binary = bytearray()
    document = dict(asset=dict(version="2.0", generator="make_scenes.py"), scene=0, scenes=[dict(nodes=[])], nodes=[], meshes=[],
                    accessors=[], bufferViews=[])

    def view(data, target):
        document["bufferViews"].append(dict(buffer=0, byteOffset=len(binary), byteLength=len(data)))
        if target is not None:
            document["bufferViews"][-1]["target"] = target
        binary.extend(data + bytes(-len(data) % 4))
        return len(document["bufferViews"]) - 1

    numbers = {}
    for name, mesh in meshes.items():
        positions = view(b"".join(struct.pack("<3f", *v) for v in mesh.vertices), 34962)
        indices = view(b"".join(struct.pack("<3H", *t) for t in mesh.triangles), 34963)
        low, high = ([f(v[axis] for v in mesh.vertices) for axis in range(3)] for f in (min, max))
        document["accessors"] += [
            dict(bufferView=positions, componentType=5126, count=len(mesh.vertices), type="VEC3", min=low, max=high),
            dict(bufferView=indices, componentType=5123, count=3 * len(mesh.triangles), type="SCALAR")]
        numbers[name] = len(document["meshes"])
        count = len(document["accessors"])
        document["meshes"].append(
            dict(name=name, primitives=[dict(attributes=dict(POSITION=count - 2), indices=count - 1)]))

    def add(node):
        result = {key: value for key, value in node.items() if key in ("name", "translation", "rotation", "scale")}
        if "mesh" in node:
            result["mesh"] = numbers[node["mesh"]]
        if "instances" in node:
            attributes = {}
            for column, (key, size) in enumerate((("TRANSLATION", 3), ("ROTATION", 4), ("SCALE", 3))):
                numbers_of = [[round(c, 5) + 0.0 for c in place[column]] for place in node["instances"]]
                data = b"".join(struct.pack("<%df" % size, *n) for n in numbers_of)
                document["accessors"].append(dict(bufferView=view(data, None), componentType=5126, count=len(numbers_of),
                                                  type="VEC%d" % size))
                attributes[key] = len(document["accessors"]) - 1
            result["extensions"] = dict(EXT_mesh_gpu_instancing=dict(attributes=attributes))
            document["extensionsUsed"] = document["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
        if "translation" in result:
            result["translation"] = [round(c, 5) + 0.0 for c in result["translation"]]
        document["nodes"].append(result)
        number = len(document["nodes"]) - 1
        if "children" in node:
            result["children"] = [add(child) for child in node["children"]]
        return number

    document["scenes"][0]["nodes"] = [add(node) for node in nodes]
    document["buffers"] = [dict(byteLength=len(binary))]
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(b"glTF" + struct.pack("<2I", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<2I", len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<2I", len(binary), 0x004E4942) + binary)


def write_ply(path, mesh):
    header = ("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
              "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (len(mesh.vertices), len(mesh.triangles)))
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(b"".join(struct.pack("<3f", *v) for v in mesh.vertices))
        file.write(b"".join(struct.pack("<B3i", 3, *t) for t in mesh.triangles))


def write_table_obj(path):
    """A table with four legs, with quads, groups, and vertices counted back from the last."""
    lines = ["# A table: a top and four legs, each a box of quads."]
    parts = [("top", (0, 0.72, 0), (1.6, 0.06, 0.9))]
    parts += [("leg%d" % i, (x, 0, z), (0.07, 0.72, 0.07)) for i, (x, z) in
              enumerate(((-0.74, -0.39), (0.74, -0.39), (0.74, 0.39), (-0.74, 0.39)))]
    for name, (x, y, z), size in parts:
        lines.append("g " + name)
        lines += ["v %.5f %.5f %.5f" % (vx + x, vy + y, vz + z) for vx, vy, vz in box(*size).vertices]
        lines += ["f %d %d %d %d" % tuple(i - 8 for i in face) for face in
                  ((0, 1, 2, 3), (7, 6, 5, 4), (4, 5, 1, 0), (5, 6, 2, 1), (6, 7, 3, 2), (7, 4, 0, 3))]
    with open(path, "w", newline="\n") as file:
        file.write("\n".join(lines) + "\n")


def write_gear_stl(path, teeth=20):
    """A gear with a bore, as binary STL."""
    outline = []
    for i in range(teeth):
        for fraction, radius in ((0.0, 0.85), (0.25, 0.85), (0.35, 1.0), (0.65, 1.0), (0.75, 0.85)):
            outline.append((radius, 2 * math.pi * (i + fraction) / teeth))
    mesh = Mesh()
    rings = [[mesh.vertex(r * math.cos(a), y, r * math.sin(a)) for r, a in path]
             for path in ([(0.3, a) for _, a in outline], outline) for y in (0, 0.3)]
    bore_low, bore_high, rim_low, rim_high = rings
    for i in range(len(outline)):
        j = (i + 1) % len(outline)
        mesh.quad(rim_low[i], rim_high[i], rim_high[j], rim_low[j])
        mesh.quad(bore_low[j], bore_high[j], bore_high[i], bore_low[i])
        mesh.quad(bore_high[i], bore_high[j], rim_high[j], rim_high[i])
        mesh.quad(bore_low[j], bore_low[i], rim_low[i], rim_low[j])
    with open(path, "wb") as file:
        file.write(b"A gear of %d teeth, written by make_scenes.py".ljust(80) % teeth)
        file.write(struct.pack("<I", len(mesh.triangles)))
        for t in mesh.triangles:
            corners = [c for v in t for c in mesh.vertices[v]]
            file.write(struct.pack("<12fH", 0, 0, 0, *corners, 0))


def main():
    write_glb(os.path.join(HERE, "courtyard.glb"), *courtyard())
    write_glb(os.path.join(HERE, "orchard.glb"), *orchard())
    write_ply(os.path.join(HERE, "torus.ply"), torus(1.0, 0.4, 96, 48))
    write_table_obj(os.path.join(HERE, "table.obj"))
    write_gear_stl(os.path.join(HERE, "gear.stl"))


if __name__ == "__main__":
    main()
