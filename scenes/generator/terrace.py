#!/usr/bin/env python3
"""Writes terrace.glb: what textures, alpha and vertex colours do, in one small scene. Every texture is
computed here. Python's standard library alone."""

import json
import math
import struct
import sys
import zlib

REPEAT, CLAMP, MIRROR = 10497, 33071, 33648
NEAREST, LINEAR, MIPMAPPED = 9728, 9729, 9987


def png(width, height, rgba):
    """rgba(x, y): four numbers from 0 to 1."""
    rows = b"".join(
        b"\0" + bytes(round(255 * min(max(c, 0), 1)) for x in range(width) for c in rgba(x, y))
        for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def noise(x, y, period, seed=0):
    """Value noise that repeats after `period`, 0 to 1."""
    def at(i, j):
        h = (i % period) * 374761393 + (j % period) * 668265263 + seed * 2147483647
        h = (h ^ (h >> 13)) * 1274126177 & 0xFFFFFFFF
        return ((h ^ (h >> 16)) & 0xFFFF) / 0xFFFF
    i, j = math.floor(x), math.floor(y)
    fx, fy = x - i, y - j
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
    return ((at(i, j) * (1 - fx) + at(i + 1, j) * fx) * (1 - fy)
            + (at(i, j + 1) * (1 - fx) + at(i + 1, j + 1) * fx) * fy)


def normal_map(width, height, height_at, strength):
    def rgba(x, y):
        dx = (height_at(x + 1, y) - height_at(x - 1, y)) * strength
        dy = (height_at(x, y + 1) - height_at(x, y - 1)) * strength
        n = (-dx, dy, 1.0)  # green grows upwards, rows downwards
        size = math.sqrt(sum(c * c for c in n))
        return tuple(0.5 * c / size + 0.5 for c in n) + (1.0,)
    return png(width, height, rgba)


class Tiles:
    """Four glazed tiles and the joints between them."""
    size = 128

    def inside(self, x, y):
        """0 in a joint, 1 on a tile."""
        half = self.size // 2
        edge = min(x % half, half - x % half, y % half, half - y % half)
        return min(max((edge - 2) / 3, 0), 1)

    def height(self, x, y):
        return self.inside(x, y) + 0.05 * noise(x / 4, y / 4, 32)

    def color(self, x, y):
        half = self.size // 2
        odd = (x // half + y // half) % 2
        tone = 0.85 + 0.15 * noise(x / 8, y / 8, 16, 1)
        tile = (0.72, 0.36, 0.22) if odd else (0.85, 0.78, 0.62)
        t = self.inside(x, y)
        return tuple((t * a + (1 - t) * 0.35) * tone for a in tile) + (1.0,)

    def occlusion_roughness_metallic(self, x, y):
        t = self.inside(x, y)
        return (0.4 + 0.6 * t, 0.95 - 0.85 * t + 0.1 * noise(x / 8, y / 8, 16, 2), 0.0, 1.0)


class Bricks:
    size = 128

    def inside(self, x, y):
        row = y // 32
        x = (x + 32 * (row % 2)) % 64
        edge = min(x, 64 - x, y % 32, 32 - y % 32)
        return min(max((edge - 1.5) / 2.5, 0), 1)

    def height(self, x, y):
        return self.inside(x, y) * (0.8 + 0.3 * noise(x / 4, y / 4, 32, 3))

    def color(self, x, y):
        t = self.inside(x, y)
        tone = 0.7 + 0.3 * noise(x / 6.4, y / 6.4, 20, 4)
        return tuple((t * a + (1 - t) * b) * tone for a, b in zip((0.62, 0.27, 0.2), (0.6, 0.58, 0.52))) + (1.0,)


def leaf(x, y):
    """A leaf with a vein; nothing around it."""
    u, v = (x + 0.5) / 64 * 2 - 1, (y + 0.5) / 64
    width = 0.85 * math.sin(math.pi * min(v, 1) ** 0.8)
    inside = 1.0 if abs(u) < width and 0.02 < v < 0.98 else 0.0
    vein = 1.0 if abs(u) < 0.06 or abs((abs(u) * 0.7 + v) * 6 % 1 - 0.5) < 0.06 else 0.0
    green = 0.45 + 0.2 * v + 0.15 * vein
    return (0.18 + 0.3 * vein, green, 0.12, inside)


def veil(x, y):
    """Stripes of coloured gauze, from nothing to nearly opaque."""
    stripe = (x // 16) % 2
    return (0.9, 0.3 + 0.5 * stripe, 0.35, (0.15 + 0.75 * y / 63) * (1.0 if stripe else 0.75))


def lantern(x, y):
    """Bright panes in a dark frame."""
    pane = 1.0 if 4 <= x % 32 < 28 and 4 <= y % 32 < 28 else 0.0
    return (pane, 0.72 * pane, 0.36 * pane, 1.0)


class File:
    def __init__(self):
        self.binary = b""
        self.json = {
            "asset": {"version": "2.0", "generator": "Pinocchio scenes/generator/terrace.py"},
            "scene": 0, "scenes": [{"nodes": [], "extras": {"pinocchio": {"ambient": 0.25}}}],
            "nodes": [], "meshes": [], "accessors": [], "bufferViews": [], "images": [], "textures": [],
            "samplers": [], "materials": [], "cameras": [],
            "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit",
                               "KHR_texture_transform"],
            "extensions": {"KHR_lights_punctual": {"lights": []}}}

    def add(self, kind, thing):
        self.json[kind].append(thing)
        return len(self.json[kind]) - 1

    def view(self, data):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        return view

    def texture(self, data, wrap=REPEAT, mag=LINEAR):
        image = self.add("images", {"bufferView": self.view(data), "mimeType": "image/png"})
        sampler = self.add("samplers", {"wrapS": wrap, "wrapT": wrap, "magFilter": mag, "minFilter": MIPMAPPED})
        return self.add("textures", {"source": image, "sampler": sampler})

    def accessor(self, rows, kind):
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
        flat = [c for row in rows for c in (row if width > 1 else (row,))]
        code, component = ("I", 5125) if kind == "SCALAR" else ("f", 5126)
        accessor = {"bufferView": self.view(struct.pack(f"<{len(flat)}{code}", *flat)), "componentType": component,
                    "count": len(rows), "type": kind}
        if kind == "VEC3":
            accessor["min"] = [min(r[i] for r in rows) for i in range(3)]
            accessor["max"] = [max(r[i] for r in rows) for i in range(3)]
        return self.add("accessors", accessor)

    def mesh(self, name, material, points, normals, triangles, **more):
        attributes = {"POSITION": self.accessor(points, "VEC3"), "NORMAL": self.accessor(normals, "VEC3")}
        for key, rows in more.items():
            attributes[key] = self.accessor(rows, f"VEC{len(rows[0])}")
        indices = self.accessor([i for t in triangles for i in t], "SCALAR")
        mesh = self.add("meshes", {"name": name, "primitives": [
            {"attributes": attributes, "indices": indices, "material": material}]})
        self.node({"name": name, "mesh": mesh})

    def node(self, node):
        self.json["scenes"][0]["nodes"].append(self.add("nodes", node))

    def glb(self):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = (struct.pack("<I4s", len(text), b"JSON") + text
                  + struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary)
        return struct.pack("<4sII", b"glTF", 2, len(chunks) + 12) + chunks


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def rectangle(file, name, material, corner, right, up, repeat=(1, 1), **more):
    """From its lower left corner; texture coordinates grow to the right and down."""
    points = [tuple(c + i * r + j * u for c, r, u in zip(corner, right, up)) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    n = cross(right, up)
    size = math.sqrt(sum(c * c for c in n))
    normal = tuple(c / size for c in n)
    uv = [(i * repeat[0], (1 - j) * repeat[1]) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    file.mesh(name, material, points, [normal] * 4, [(0, 1, 2), (0, 2, 3)], TEXCOORD_0=uv, **more)


def box(file, name, material, centre, size):
    points, normals, uvs, triangles = [], [], [], []
    for axis in range(3):
        for side in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(points)
            for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = [0, 0, 0]
                p[axis], p[u], p[v] = side, i * side, j
                points.append(tuple(c + 0.5 * s * q for c, s, q in zip(centre, size, p)))
                normals.append(tuple(side if k == axis else 0 for k in range(3)))
                uvs.append((0.5 + 0.5 * i, 0.5 - 0.5 * j))
            triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    file.mesh(name, material, points, normals, triangles, TEXCOORD_0=uvs)


def sphere(file, name, material, centre, radius, columns=48, rows=24):
    points, normals, colors, triangles = [], [], [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            a, b = 2 * math.pi * i / columns, math.pi * j / rows
            n = (math.cos(a) * math.sin(b), math.cos(b), math.sin(a) * math.sin(b))
            normals.append(n)
            points.append(tuple(c + radius * k for c, k in zip(centre, n)))
            colors.append((0.5 + 0.5 * math.cos(a), 0.35 + 0.3 * math.cos(b), 0.5 - 0.4 * math.cos(a)))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            triangles += [(a, a + 1, a + columns + 2), (a, a + columns + 2, a + columns + 1)]
    file.mesh(name, material, points, normals, triangles, COLOR_0=colors)


def hedge(file, material, count=420):
    points, normals, uvs, triangles = [], [], [], []
    state = 7

    def random():
        nonlocal state
        state = (state * 1103515245 + 12345) & 0x7FFFFFFF
        return state / 0x7FFFFFFF
    for _ in range(count):
        a, tilt, size = 2 * math.pi * random(), 0.9 * (random() - 0.5), 0.16 + 0.1 * random()
        at = (-2.3 + 1.5 * random(), 0.12 + 1.05 * random(), -1.2 + 0.6 * random())
        right = (math.cos(a), 0.0, math.sin(a))
        up = (-math.sin(a) * math.sin(tilt), math.cos(tilt), math.cos(a) * math.sin(tilt))
        first = len(points)
        for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)):
            points.append(tuple(p + size * ((i - 0.5) * r + j * u) for p, r, u in zip(at, right, up)))
            normals.append(cross(right, up))
            uvs.append((i, 1 - j))
        triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    file.mesh("hedge", material, points, normals, triangles, TEXCOORD_0=uvs)


def scene():
    f = File()
    tiles, bricks = Tiles(), Bricks()
    size = Tiles.size
    tile_color = f.texture(png(size, size, tiles.color))
    tile_normal = f.texture(normal_map(size, size, tiles.height, 1.2))
    tile_orm = f.texture(png(size, size, tiles.occlusion_roughness_metallic))
    brick_color = f.texture(png(size, size, bricks.color))
    brick_normal = f.texture(normal_map(size, size, bricks.height, 1.5))
    leaf_color = f.texture(png(64, 64, leaf), CLAMP)
    veil_color = f.texture(png(64, 64, veil), CLAMP)
    lantern_color = f.texture(png(64, 64, lantern), REPEAT, NEAREST)
    sign_color = f.texture(png(16, 16, lambda x, y: ((x * 7 + y * 3) % 5 / 4, (x + y) % 2 * 0.8, y / 15, 1)), MIRROR, NEAREST)

    floor = f.add("materials", {
        "name": "tiles", "normalTexture": {"index": tile_normal}, "occlusionTexture": {"index": tile_orm},
        "pbrMetallicRoughness": {"baseColorTexture": {"index": tile_color},
                                 "metallicRoughnessTexture": {"index": tile_orm}}})
    wall = f.add("materials", {
        "name": "bricks", "normalTexture": {"index": brick_normal, "scale": 0.8},
        "pbrMetallicRoughness": {
            "baseColorTexture": {"index": brick_color,
                                 "extensions": {"KHR_texture_transform": {"scale": [2, 2], "offset": [0.25, 0]}}},
            "metallicFactor": 0, "roughnessFactor": 0.9}})
    f.json["materials"][wall]["normalTexture"]["extensions"] = {
        "KHR_texture_transform": {"scale": [2, 2], "offset": [0.25, 0]}}
    leaves = f.add("materials", {
        "name": "leaves", "alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": True,
        "pbrMetallicRoughness": {"baseColorTexture": {"index": leaf_color}, "metallicFactor": 0, "roughnessFactor": 0.6}})
    gauze = f.add("materials", {
        "name": "gauze", "alphaMode": "BLEND", "doubleSided": True,
        "pbrMetallicRoughness": {"baseColorTexture": {"index": veil_color}, "metallicFactor": 0}})
    lamp = f.add("materials", {
        "name": "lantern", "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": lantern_color},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1.5}},
        "pbrMetallicRoughness": {"baseColorFactor": [0.08, 0.08, 0.08, 1], "metallicFactor": 0, "roughnessFactor": 0.5}})
    sign = f.add("materials", {
        "name": "sign", "extensions": {"KHR_materials_unlit": {}},
        "pbrMetallicRoughness": {"baseColorTexture": {"index": sign_color, "texCoord": 1}}})
    ball = f.add("materials", {"name": "painted ball", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.4}})
    chrome = f.add("materials", {
        "name": "chrome ball", "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.9, 0.92, 1], "roughnessFactor": 0.0}})

    rectangle(f, "floor", floor, (-4, 0, 4), (8, 0, 0), (0, 0, -6), (8, 6))
    rectangle(f, "wall", wall, (-4, 0, -2), (8, 0, 0), (0, 3, 0), (4, 1.5))
    hedge(f, leaves)
    rectangle(f, "veil", gauze, (0.35, 0.15, 0.3), (1.3, 0, 0.35), (0, 1.5, 0))
    box(f, "lantern", lamp, (2.3, 0.4, -0.6), (0.5, 0.8, 0.5))
    rectangle(f, "sign", sign, (1.2, 1.7, -1.98), (1.4, 0, 0), (0, 0.7, 0),
              TEXCOORD_1=[(-0.5, 1.0), (2.0, 1.0), (2.0, 0.0), (-0.5, 0.0)])
    sphere(f, "painted ball", ball, (0.95, 0.35, -0.9), 0.35)
    sphere(f, "chrome ball", chrome, (-0.35, 0.45, -0.3), 0.45)
    f.json["meshes"][-1]["primitives"][0]["attributes"].pop("COLOR_0")

    lights = f.json["extensions"]["KHR_lights_punctual"]["lights"]
    lights += [{"name": "evening sun", "type": "directional", "color": [1, 0.9, 0.75], "intensity": 2.4},
               {"name": "lamp", "type": "point", "color": [1, 0.75, 0.45], "intensity": 4}]
    f.node({"name": "sun", "rotation": [-0.387, 0.305, 0.138, 0.859],
            "extensions": {"KHR_lights_punctual": {"light": 0}}})
    f.node({"name": "lamp", "translation": [2.0, 1.6, 0.8], "extensions": {"KHR_lights_punctual": {"light": 1}}})
    f.add("cameras", {"type": "perspective", "perspective": {"yfov": 0.72, "znear": 0.01}})
    f.node({"name": "main", "camera": 0, "translation": [0.2, 1.45, 4.6], "rotation": [-0.085, 0, 0, 0.99638],
            "extras": {"pinocchio": {"target": [0.0, 0.75, -0.4]}}})
    return f.glb()


if __name__ == "__main__":
    with open(sys.argv[1] if len(sys.argv) > 1 else "terrace.glb", "wb") as out:
        out.write(scene())
