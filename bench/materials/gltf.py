"""Reads what a glTF 2.0 binary file draws, for Mitsuba: triangles in the world and their materials. A reader apart from ours; needs NumPy and Pillow.

Only what both renderers can draw alike is kept: `reduced` writes the file without the rest.
"""
import copy
import io
import json
import struct

import numpy

WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
TYPES = {5120: numpy.int8, 5121: numpy.uint8, 5122: numpy.int16, 5123: numpy.uint16, 5125: numpy.uint32, 5126: numpy.float32}
KEPT_OF_MATERIALS = ("name", "pbrMetallicRoughness", "normalTexture", "alphaMode", "alphaCutoff", "doubleSided")


def read(path):
    """The document and its binary part."""
    data = path.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length]), data[28 + length:]


def write(path, document, data):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    path.write_bytes(struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(data), len(text), 0x4E4F534A) + text +
                     struct.pack("<II", len(data), 0x004E4942) + data)


def reduced(document, steel=None):
    """Without lights, glow, occlusion, animations, skins, morphs, vertex colours, samplers, blending and extensions: what is left both draw alike.
    steel: (base colour, roughness) that replaces all materials by an even metal."""
    document = copy.deepcopy(document)
    left = {k: v for k, v in document.items() if k not in ("animations", "skins", "cameras", "extensions", "extensionsUsed", "extensionsRequired")}
    left["materials"] = [{k: v for k, v in m.items() if k in KEPT_OF_MATERIALS} for m in document.get("materials", [])]
    for material in left["materials"]:
        if material.get("alphaMode") == "BLEND":
            del material["alphaMode"]
        if steel:
            material.pop("alphaMode", None)
            material.pop("normalTexture", None)
            material["pbrMetallicRoughness"] = {"baseColorFactor": [*steel[0], 1.0], "metallicFactor": 1.0, "roughnessFactor": steel[1]}
        for texture in textures_of(material):
            texture.pop("extensions", None)
        material["doubleSided"] = True
    for texture in left.get("textures", []):
        texture.pop("sampler", None)
    for mesh in left.get("meshes", []):
        for primitive in mesh["primitives"]:
            for gone in ("targets", "extensions"):
                primitive.pop(gone, None)
            for name in [n for n in primitive["attributes"] if n not in ("POSITION", "NORMAL", "TEXCOORD_0", "TEXCOORD_1")]:
                del primitive["attributes"][name]
        mesh.pop("weights", None)
    for node in left.get("nodes", []):
        for gone in ("skin", "camera", "extensions", "weights"):
            node.pop(gone, None)
    return left


def flat(document):
    """Without vertex normals and normal maps."""
    document = copy.deepcopy(document)
    for mesh in document.get("meshes", []):
        for primitive in mesh["primitives"]:
            primitive["attributes"].pop("NORMAL", None)
    for material in document.get("materials", []):
        material.pop("normalTexture", None)
    return document


def textures_of(material):
    of_base = material.get("pbrMetallicRoughness", {})
    named = (of_base.get("baseColorTexture"), of_base.get("metallicRoughnessTexture"), material.get("normalTexture"))
    return [t for t in named if t]


def accessor(document, data, index):
    found = document["accessors"][index]
    kind, width = numpy.dtype(TYPES[found["componentType"]]), WIDTHS[found["type"]]
    if "bufferView" not in found:
        return numpy.zeros((found["count"], width), numpy.float32)
    view = document["bufferViews"][found["bufferView"]]
    begin = view.get("byteOffset", 0) + found.get("byteOffset", 0)
    stride = view.get("byteStride", kind.itemsize * width)
    raw = numpy.frombuffer(data, numpy.uint8)[begin:]
    rows = numpy.lib.stride_tricks.as_strided(raw, (found["count"], kind.itemsize * width), (stride, 1))
    values = numpy.ascontiguousarray(rows).view(kind).reshape(found["count"], width)
    if found.get("normalized"):
        return numpy.maximum(values.astype(numpy.float32) / numpy.iinfo(kind).max, -1)
    return values


def matrix_of(node):
    if "matrix" in node:
        return numpy.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turn = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    matrix = numpy.eye(4)
    matrix[:3, :3] = turn * numpy.array(node.get("scale", (1, 1, 1)))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def placed(document):
    """Each mesh of the shown scene with its matrix."""
    nodes = document.get("nodes", [])
    waiting = [(i, numpy.eye(4)) for i in document["scenes"][document.get("scene", 0)].get("nodes", [])]
    while waiting:
        index, above = waiting.pop()
        matrix = above @ matrix_of(nodes[index])
        if "mesh" in nodes[index]:
            yield document["meshes"][nodes[index]["mesh"]], matrix
        waiting += [(child, matrix) for child in nodes[index].get("children", [])]


def parts(document, data):
    """For each primitive of triangles: positions, normals or None, texture coordinates by set, triangles, the material's index or None."""
    for mesh, matrix in placed(document):
        turn = matrix[:3, :3]
        for primitive in mesh["primitives"]:
            if primitive.get("mode", 4) != 4 or "POSITION" not in primitive["attributes"]:
                continue
            names = primitive["attributes"]
            positions = accessor(document, data, names["POSITION"]) @ turn.T + matrix[:3, 3]
            normals = None
            if "NORMAL" in names:
                normals = accessor(document, data, names["NORMAL"]) @ numpy.linalg.inv(turn)
                normals = normals / numpy.maximum(numpy.linalg.norm(normals, axis=1, keepdims=True), 1e-20)
            corners = accessor(document, data, primitive["indices"]).ravel() if "indices" in primitive else numpy.arange(len(positions))
            faces = corners.astype(numpy.int64)[:len(corners) // 3 * 3].reshape(-1, 3)
            if numpy.linalg.det(turn) < 0:
                faces = faces[:, ::-1]
            sets = {k: accessor(document, data, names[f"TEXCOORD_{k}"]) for k in (0, 1) if f"TEXCOORD_{k}" in names}
            yield positions, normals, sets, faces, primitive.get("material")


def image_of(document, data, texture):
    """A texture's pixels, 0 to 1, (height, width, 4)."""
    import PIL.Image

    view = document["bufferViews"][document["images"][document["textures"][texture["index"]]["source"]]["bufferView"]]
    begin = view.get("byteOffset", 0)
    picture = PIL.Image.open(io.BytesIO(data[begin:begin + view["byteLength"]])).convert("RGBA")
    return numpy.asarray(picture).astype(numpy.float32) / 255


def linear(srgb):
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
