#!/usr/bin/env python3
"""Writes windmill.glb, which moves for four seconds and begins again: sails of masked cloth turn with their node, a
flag follows its skin's joints, and a ball hops and is squashed by a morph target. Every texture is computed
here. Python's standard library alone."""

import math
import struct
import sys

from terrace import CLAMP, Bricks, File, noise, normal_map, png, rectangle

DURATION_S = 4.0


class MovingFile(File):
    """With animations and skins."""

    def __init__(self):
        super().__init__()
        self.json["asset"]["generator"] = "Pinocchio scenes/generator/windmill.py"
        self.json["extensionsUsed"] = ["KHR_lights_punctual", "KHR_materials_unlit"]
        self.json["skins"] = []
        self.json["animations"] = [{"name": "wind", "channels": [], "samplers": []}]

    def numbers(self, rows, kind):
        flat = [c for row in rows for c in row]
        return self.add("accessors", {"bufferView": self.view(struct.pack(f"<{len(flat)}f", *flat)),
                                      "componentType": 5126, "count": len(rows), "type": kind})

    def joints(self, rows):
        data = bytes(c for row in rows for c in row)
        return self.add("accessors", {"bufferView": self.view(data), "componentType": 5121, "count": len(rows),
                                      "type": "VEC4"})

    def animate(self, node, path, times, rows, interpolation="LINEAR"):
        kind = {"rotation": "VEC4", "weights": "SCALAR"}.get(path, "VEC3")
        times_accessor = self.numbers([(t,) for t in times], "SCALAR")
        self.json["accessors"][times_accessor].update(min=[times[0]], max=[times[-1]])
        animation = self.json["animations"][0]
        animation["samplers"].append({"input": times_accessor, "output": self.numbers(rows, kind),
                                      "interpolation": interpolation})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": {"node": node, "path": path}})

    def child(self, parent, node):
        index = self.add("nodes", node)
        self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def last_node_under(self, parent):
        """Hangs the node that was made last on another; its index."""
        index = self.json["scenes"][0]["nodes"].pop()
        self.json["nodes"][parent].setdefault("children", []).append(index)
        return index


def turn(axis, angle):
    return tuple(math.sin(angle / 2) * c for c in axis) + (math.cos(angle / 2),)


def grid(columns, rows, at):
    """Points, normals by differences, texture coordinates and triangles of at(u, v), u to the right, v down."""
    step = 1e-3

    def normal(u, v):
        a, b, c, d = at(u - step, v), at(u + step, v), at(u, v - step), at(u, v + step)
        du, dv = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(c, d)]
        n = (dv[1] * du[2] - dv[2] * du[1], dv[2] * du[0] - dv[0] * du[2], dv[0] * du[1] - dv[1] * du[0])
        size = math.sqrt(sum(k * k for k in n))
        # Where a row is one point, as it is beside it.
        return tuple(k / size for k in n) if size > 1e-12 else normal(u, v + (step if v < 0.5 else -step))

    points, normals, uvs, triangles = [], [], [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            normals.append(normal(u, v))
            points.append(at(u, v))
            uvs.append((u, v))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            triangles += [(a, a + columns + 1, a + columns + 2), (a, a + columns + 2, a + 1)]
    return points, normals, uvs, triangles


def height(x, z):
    return 0.18 * math.sin(0.9 * x + 0.4) * math.cos(0.7 * z) + 0.05 * math.sin(2.7 * x - 1.9 * z)


def ground(f, material):
    points, normals, uvs, triangles = grid(64, 64, lambda u, v: (
        12 * u - 6, height(12 * u - 6, 10 * v - 6.5), 10 * v - 6.5))
    f.mesh("ground", material, points, normals, triangles, TEXCOORD_0=[(6 * u, 5 * v) for u, v in uvs])


def round_wall(f, name, material, x, z, levels, repeat, columns=64, rows=32):
    """A surface of revolution around (x, z) through (radius, height) of `levels`, from the top down."""
    def at(u, v):
        angle = -2 * math.pi * u
        k = min(max(v, 0), 1) * (len(levels) - 1)
        i = min(int(k), len(levels) - 2)
        (r0, y0), (r1, y1) = levels[i], levels[i + 1]
        t = k - i
        radius = r0 + t * (r1 - r0)
        return (x + radius * math.cos(angle), y0 + t * (y1 - y0), z + radius * math.sin(angle))
    points, normals, uvs, triangles = grid(columns, rows, at)
    f.mesh(name, material, points, normals, triangles, TEXCOORD_0=[(repeat[0] * u, repeat[1] * v) for u, v in uvs])


def lattice(x, y):
    """Laths with cloth between some of them; the rest is open."""
    lath = x % 16 < 3 or y % 16 < 3 or x >= 61 or y >= 61
    cloth = (x // 16) % 2 == 0 and y // 16 < 3
    tone = 0.8 + 0.2 * noise(x / 4, y / 4, 16, 5)
    if lath:
        return (0.42 * tone, 0.3 * tone, 0.18 * tone, 1.0)
    return (0.9 * tone, 0.86 * tone, 0.74 * tone, 1.0 if cloth else 0.0)


def grass(x, y):
    tone = 0.55 + 0.25 * noise(x / 4, y / 4, 32, 6) + 0.2 * noise(x / 16, y / 16, 8, 7)
    return (0.42 * tone, 0.66 * tone, 0.25 * tone, 1.0)


def stripes(x, y):
    tone = 0.9 + 0.1 * noise(x / 4, y / 4, 16, 8)
    color = ((0.8, 0.16, 0.14), (0.93, 0.9, 0.82), (0.13, 0.3, 0.62))[min(y // 22, 2)]
    return tuple(c * tone for c in color) + (1.0,)


def evening(x, y):
    t = y / 63
    return (0.45 + 0.5 * t, 0.66 + 0.24 * t, 0.95 - 0.1 * t, 1.0)


def dots(x, y):
    inside = (x % 16 - 8) ** 2 + (y % 16 - 8) ** 2 < 24
    return (0.95, 0.8, 0.2, 1.0) if inside else (0.75, 0.12, 0.3, 1.0)


def sails(f, cloth):
    hub = f.add("nodes", {"name": "sails", "translation": [-1.1, 2.75, 0.12]})
    f.json["scenes"][0]["nodes"].append(hub)
    for k in range(4):
        rectangle(f, f"sail {k}", cloth, (0.05, 0.22, 0.0), (0.52, 0, 0.06), (0, 1.55, 0), (1, 2))
        f.json["nodes"][f.last_node_under(hub)]["rotation"] = turn((0, 0, 1), k * math.pi / 2)
    keys = 8
    f.animate(hub, "rotation", [DURATION_S * k / keys for k in range(keys + 1)],
              [turn((0, 0, 1), -math.pi * k / keys) for k in range(keys + 1)])


def flag(f, cloth, pole):
    bones, columns, rows, length = 5, 48, 16, 1.6
    x0, y0, z0 = 0.95, 1.55, -0.6
    points, normals, uvs, triangles = grid(columns, rows, lambda u, v: (x0 + length * u, y0 + 0.8 * (1 - v), z0))
    f.mesh("flag", cloth, points, normals, triangles, TEXCOORD_0=uvs)
    names, weights = [], []
    for u, _ in uvs:
        k = u * (bones - 1)
        i = min(int(k), bones - 2)
        names.append((i, i + 1, 0, 0))
        weights.append((1 - (k - i), k - i, 0.0, 0.0))
    attributes = f.json["meshes"][-1]["primitives"][0]["attributes"]
    attributes["JOINTS_0"], attributes["WEIGHTS_0"] = f.joints(names), f.numbers(weights, "VEC4")
    mesh_node = f.json["nodes"][-1]
    step = length / (bones - 1)
    joints = [f.add("nodes", {"name": "flag 0", "translation": [x0, y0, z0]})]
    f.json["scenes"][0]["nodes"].append(joints[0])
    for k in range(1, bones):
        joints.append(f.child(joints[-1], {"name": f"flag {k}", "translation": [step, 0, 0]}))
    inverse = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x0 - step * k, -y0, -z0, 1) for k in range(bones)]
    f.json["skins"].append({"joints": joints, "inverseBindMatrices": f.numbers(inverse, "MAT4")})
    mesh_node["skin"] = 0
    keys = 16
    for k, joint in enumerate(joints):
        angles = [(0.35 + 0.3 * (k > 0)) * math.sin(2 * math.pi * (2 * t / keys) - 1.25 * k) for t in range(keys + 1)]
        f.animate(joint, "rotation", [DURATION_S * t / keys for t in range(keys + 1)],
                  [turn((0, 1, 0), a) for a in angles])
    round_wall(f, "pole", pole, x0 - 0.03, z0, [(0.0, 2.45), (0.035, 2.42), (0.035, 0.0)], (1, 4), 16, 16)


def ball(f, material):
    radius = 0.32
    points, normals, uvs, triangles = grid(48, 24, lambda u, v: (
        radius * math.sin(math.pi * v) * math.cos(-2 * math.pi * u), radius * math.cos(math.pi * v),
        radius * math.sin(math.pi * v) * math.sin(-2 * math.pi * u)))
    normals = [tuple(c / radius for c in p) for p in points]
    f.mesh("ball", material, points, normals, triangles, TEXCOORD_0=[(3 * u, 2 * v) for u, v in uvs])
    # Squashed to 0.6 of its height, and as much wider as keeps its volume; normals by the inverse.
    flat, wide = 0.6, 1 / math.sqrt(0.6)
    squashed = [(wide * x, flat * (y + radius) - radius, wide * z) for x, y, z in points]
    bent = []
    for x, y, z in normals:
        n = (x / wide, y / flat, z / wide)
        size = math.sqrt(sum(c * c for c in n))
        bent.append(tuple(c / size for c in n))
    f.json["meshes"][-1]["primitives"][0]["targets"] = [
        {"POSITION": f.accessor([tuple(b - a for a, b in zip(p, q)) for p, q in zip(points, squashed)], "VEC3"),
         "NORMAL": f.accessor([tuple(b - a for a, b in zip(p, q)) for p, q in zip(normals, bent)], "VEC3")}]
    f.json["meshes"][-1]["weights"] = [0]
    node, x, z = len(f.json["nodes"]) - 1, 0.35, 1.35
    floor = max(height(x + dx, z) for dx in (-0.2, 0, 0.2)) + radius
    f.json["nodes"][node]["translation"] = [x, floor, z]
    # Four hops of a second: each a parabola, which one cubic piece is.
    top = 0.9
    times = [k / 2 for k in range(9)]
    rows = []
    for k in range(9):
        on_ground = k % 2 == 0
        slope = 4 * top if on_ground else 0.0
        rows += [(0, -slope, 0), (x, floor + (0 if on_ground else top), z), (0, slope, 0)]
    f.animate(node, "translation", times, rows, "CUBICSPLINE")
    squash_times = sorted({min(max(k + d, 0.0), DURATION_S) for k in range(5) for d in (-0.08, 0.0, 0.08)})
    f.animate(node, "weights", squash_times, [(1.0 if abs(t - round(t)) < 1e-6 else 0.0,) for t in squash_times])


def scene():
    f = MovingFile()
    bricks = Bricks()

    def material(name, texture, **more):
        return f.add("materials", {"name": name, **more, "pbrMetallicRoughness": {
            "baseColorTexture": {"index": texture}, "metallicFactor": 0, "roughnessFactor": 0.8}})
    meadow = material("grass", f.texture(png(128, 128, grass)))
    wall = material("bricks", f.texture(png(128, 128, bricks.color)),
                    normalTexture={"index": f.texture(normal_map(128, 128, bricks.height, 1.5))})
    laths = material("sail cloth", f.texture(png(64, 64, lattice)), alphaMode="MASK", alphaCutoff=0.5, doubleSided=True)
    flag_cloth = material("flag", f.texture(png(64, 66, stripes), CLAMP), doubleSided=True)
    painted = material("dots", f.texture(png(64, 64, dots)))
    wood = f.add("materials", {"name": "wood", "pbrMetallicRoughness": {
        "baseColorFactor": [0.3, 0.19, 0.1, 1], "metallicFactor": 0, "roughnessFactor": 0.9}})

    sky = f.add("materials", {"name": "sky", "extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {
        "baseColorTexture": {"index": f.texture(png(2, 64, evening), CLAMP)}, "metallicFactor": 0}})

    ground(f, meadow)
    rectangle(f, "sky", sky, (-24, -4, -10), (48, 0, 0), (0, 18, 0))
    round_wall(f, "tower", wall, -1.1, -0.7, [(0.5, 2.9), (0.85, -0.1)], (6, 5))
    round_wall(f, "cap", wood, -1.1, -0.7, [(0.0, 3.55), (0.58, 2.88), (0.0, 2.88)], (1, 1), 48, 16)
    sails(f, laths)
    flag(f, flag_cloth, wood)
    ball(f, painted)

    f.json["extensions"]["KHR_lights_punctual"]["lights"] += [
        {"name": "sun", "type": "directional", "color": [1, 0.95, 0.85], "intensity": 2.6}]
    f.node({"name": "sun", "rotation": [-0.387, 0.305, 0.138, 0.859], "extensions": {"KHR_lights_punctual": {"light": 0}}})
    f.add("cameras", {"type": "perspective", "perspective": {"yfov": 0.72, "znear": 0.01}})
    f.node({"name": "main", "camera": 0, "translation": [1.3, 2.0, 7.2],
            "extras": {"pinocchio": {"target": [0.0, 2.05, 0.0]}}})
    return f.glb()


if __name__ == "__main__":
    with open(sys.argv[1] if len(sys.argv) > 1 else "windmill.glb", "wb") as out:
        out.write(scene())
