"""The spheres: which materials are drawn, and their glTF files."""
import dataclasses
import math
import struct

import gltf

STEPS = [0.0, 0.17, 0.33, 0.5, 0.67, 0.83, 1.0]  # of roughness and of metallic
COLOURS = {"black": (0.0, 0.0, 0.0), "grey": (0.5, 0.5, 0.5), "white": (1.0, 1.0, 1.0), "dark red": (0.15, 0.01, 0.01),
           "dark yellow": (0.45, 0.3, 0.02), "blue": (0.05, 0.1, 0.6)}
COLOURED_ROUGHNESS = [0.17, 0.5, 1.0]
EYE, TARGET, FOV = (0.0, 0.0, 4.0), (0.0, 0.0, 0.0), 34.0  # the sphere's radius is 1
AROUND = 192  # facets


@dataclasses.dataclass(frozen=True)
class Case:
    kind: str  # "grid" or "colour"
    base: tuple
    metallic: float
    roughness: float

    @property
    def name(self):
        colour = next((name.replace(" ", "-") for name, rgb in COLOURS.items() if rgb == self.base), "colour")
        return f"{colour}-m{self.metallic:g}-r{self.roughness:g}"


def all_cases(quick=False, colours=True):
    """The grid is of white spheres, so that the even sky is a white furnace; then dielectrics of several colours, and the same as half metal.
    Without `colours`, of those the dark red dielectrics alone."""
    metals = [0.0, 0.5, 1.0] if quick else STEPS
    roughness = [0.0, 0.33, 0.67, 1.0] if quick else STEPS
    found = [Case("grid", COLOURS["white"], m, r) for m in metals for r in roughness]
    for name, colour in COLOURS.items():
        for metallic in (0.0, 0.5):
            if name != "white" and (colours or (name == "dark red" and metallic == 0)):
                found += [Case("colour", colour, metallic, r) for r in COLOURED_ROUGHNESS if not (quick and r == 0.17)]
    return found


def sphere():
    """Positions (normals are the same) and triangles of a fine sphere."""
    rings = AROUND // 2
    points = [(math.sin(t) * math.sin(p), math.cos(t), math.sin(t) * math.cos(p))
              for t in (math.pi * j / rings for j in range(rings + 1)) for p in (2 * math.pi * i / AROUND for i in range(AROUND))]
    faces = []
    for j in range(rings):
        for i in range(AROUND):
            a, b = j * AROUND + i, j * AROUND + (i + 1) % AROUND
            c, d = a + AROUND, b + AROUND
            faces += ([] if j == rings - 1 else [(a, c, d)]) + ([] if j == 0 else [(a, d, b)])
    return points, faces


def write_sphere(path, case, made=[]):
    """One sphere with that material as a .glb."""
    if not made:
        points, faces = sphere()
        made.append((len(points), len(faces), struct.pack(f"<{3 * len(points)}f", *(x for p in points for x in p)),
                     struct.pack(f"<{3 * len(faces)}I", *(i for f in faces for i in f))))
    vertices, triangles, positions, indices = made[0]
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [*case.base, 1.0], "metallicFactor": case.metallic,
                                                "roughnessFactor": case.roughness}}],
        "buffers": [{"byteLength": len(positions) + len(indices)}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions)},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
                      {"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5125, "count": 3 * triangles, "type": "SCALAR"}]}
    gltf.write(path, document, positions + indices)
    return path
