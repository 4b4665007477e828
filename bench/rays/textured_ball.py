#!/usr/bin/env python3
"""A lumpy ball with five maps of noise, each an image of its own: a hard case for what a frame spends on textures.

    bench/rays/textured_ball.py OUT.glb [--side 2048]

15,376 triangles; base colour, metallic and roughness, normal, occlusion and emission. Needs NumPy and Pillow.
"""
import argparse
import io
import json
import pathlib
import struct

import numpy as np
from PIL import Image

COLUMNS, ROWS = 124, 62


def noise(random, side, octaves):
    """0 to 1, (side, side): the mean of grids of random numbers, enlarged."""
    sum_of = np.zeros((side, side))
    for cells in octaves:
        grid = Image.fromarray((255 * random.random((cells, cells))).astype(np.uint8))
        sum_of += np.asarray(grid.resize((side, side), Image.BICUBIC)) / 255.0
    return sum_of / len(octaves)


def maps(side):
    """Base colour, metallic and roughness, normal, occlusion, emission: (side, side, 3), 8 bits."""
    random = np.random.default_rng(1)

    def of(*octaves):
        return noise(random, side, octaves)

    dy, dx = np.gradient(20.0 * of(8, 32, 128, 512))
    normal = np.stack([-dx, -dy, np.ones_like(dx)], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    base = np.stack([of(8, 64, 512) for _ in range(3)], -1)
    matter = np.stack([np.ones((side, side)), np.clip(1.6 * of(4, 16, 256) - 0.2, 0.05, 1.0), of(6, 40) > 0.52], -1)
    occlusion = np.repeat(np.clip(0.6 + 0.5 * of(16), 0.0, 1.0)[..., None], 3, -1)
    emission = (of(20, 200) > 0.72)[..., None] * np.array([0.3, 0.6, 1.0])
    return [(255.0 * values).astype(np.uint8) for values in (base, matter, 0.5 * normal + 0.5, occlusion, emission)]


def ball():
    """Positions and normals, (n, 3), texture coordinates, (n, 2), and triangles."""
    u, v = np.meshgrid(np.linspace(0.0, 1.0, COLUMNS + 1), np.linspace(0.0, 1.0, ROWS + 1))
    polar, around = np.pi * v, 2.0 * np.pi * u
    radius = 1.0 + 0.15 * np.sin(5 * around) * np.sin(3 * polar) ** 2 + 0.1 * np.sin(9 * polar) * np.cos(2 * around)
    outwards = np.stack([np.sin(polar) * np.cos(around), np.cos(polar), -np.sin(polar) * np.sin(around)], -1)
    places = radius[..., None] * outwards
    normals = np.cross(np.gradient(places, axis=0), np.gradient(places, axis=1))
    lengths = np.linalg.norm(normals, axis=-1, keepdims=True)
    normals = np.where(lengths > 1e-9, normals / np.maximum(lengths, 1e-9), outwards)
    normals *= np.where((normals * places).sum(-1, keepdims=True) < 0.0, -1.0, 1.0)
    row, column = np.mgrid[0:ROWS, 0:COLUMNS]
    a = row * (COLUMNS + 1) + column
    b, c, d = a + 1, a + COLUMNS + 1, a + COLUMNS + 2
    triangles = np.stack([a, c, b, b, c, d], -1).reshape(-1, 3)
    flat = [values.reshape(-1, values.shape[-1]).astype(np.float32) for values in (places, normals, np.stack([2.0 * u, v], -1))]
    return *flat, triangles.astype(np.uint32)


def glb(side):
    data, views = b"", []

    def view(content):
        nonlocal data
        data += bytes(-len(data) % 4)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(content)})
        data += content
        return len(views) - 1

    def png(values):
        file = io.BytesIO()
        Image.fromarray(values).save(file, "PNG", compress_level=1)
        return file.getvalue()

    places, normals, coordinates, triangles = ball()
    accessors = [{"bufferView": view(values.tobytes()), "componentType": kind, "count": values.size // length, "type": name}
                 for values, kind, length, name in ((places, 5126, 3, "VEC3"), (normals, 5126, 3, "VEC3"),
                                                    (coordinates, 5126, 2, "VEC2"), (triangles, 5125, 1, "SCALAR"))]
    accessors[0] |= {"min": places.min(0).tolist(), "max": places.max(0).tolist()}
    images = [{"bufferView": view(png(values)), "mimeType": "image/png"} for values in maps(side)]
    material = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}},
                "normalTexture": {"index": 2}, "occlusionTexture": {"index": 3}, "emissiveTexture": {"index": 4},
                "emissiveFactor": [1, 1, 1]}
    primitive = {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive]}], "materials": [material], "textures": [{"source": i} for i in range(5)],
        "images": images, "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data)}]}).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    size = 12 + 8 + len(text) + 8 + len(data)
    return struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--side", type=int, default=2048)
    arguments = parser.parse_args()
    arguments.file.write_bytes(glb(arguments.side))


if __name__ == "__main__":
    main()
