#!/usr/bin/env python3
"""What copies of a mesh cost: processor time and memory of programs that draw files whose nodes share a mesh.

copies.py PROGRAM... [--repeat N]: each file, each program in turn; a row of CSV for each, to standard output.
Processor time of a frame is that of 34 frames less that of 4, raytrace, one thread, 320 x 240; the least of N runs.
"""
import argparse
import json
import math
import os
import pathlib
import random
import struct
import subprocess
import tempfile

CASES = [(16, 10000), (36, 10), (36, 1000), (36, 10000), (100, 100), (100, 1000), (100, 10000), (1024, 10), (1024, 100),
         (1024, 1000), (5184, 10), (5184, 100), (5184, 1000)]
FRAMES = 30


def ball(rings):
    """A wavy ball of 4 * rings * rings triangles."""
    around, points, normals, corners = 2 * rings, [], [], []
    for r in range(rings + 1):
        for s in range(around):
            theta, phi = math.pi * r / rings, 2 * math.pi * s / around
            n = math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)
            size = 1 + 0.15 * math.sin(5 * theta) * math.cos(4 * phi)
            points += [size * x for x in n]
            normals += n
    for r in range(rings):
        for s in range(around):
            a, b = r * around + s, r * around + (s + 1) % around
            corners += [a, b, b + around, a, b + around, a + around]
    return points, normals, corners


def write_grid(path, triangles, copies):
    """Copies on a ground: turned, stretched and mirrored at random, under a light and before a camera."""
    rng = random.Random(5)
    binary, views, accessors = b"", [], []

    def add(numbers, letter, component, kind, width):
        nonlocal binary
        data = struct.pack(f"<{len(numbers)}{letter}", *numbers)
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        binary += data
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(numbers) // width, "type": kind})
        if kind == "VEC3":
            accessors[-1].update(min=[min(numbers[i::3]) for i in range(3)], max=[max(numbers[i::3]) for i in range(3)])
        return len(accessors) - 1

    points, normals, corners = ball(round((triangles / 4) ** 0.5))
    side = math.ceil(copies**0.5)
    g = 3.0 * side
    meshes = [
        {"primitives": [{"attributes": {"POSITION": add(points, "f", 5126, "VEC3", 3), "NORMAL": add(normals, "f", 5126, "VEC3", 3)},
                         "indices": add(corners, "I", 5125, "SCALAR", 1)}]},
        {"primitives": [{"attributes": {"POSITION": add([-g, -2, -g, g, -2, -g, g, -2, g, -g, -2, g], "f", 5126, "VEC3", 3)},
                         "indices": add([0, 2, 1, 0, 3, 2], "I", 5125, "SCALAR", 1)}]}]
    nodes = [{"mesh": 1}]
    for i in range(copies):
        turn = [rng.gauss(0, 1) for _ in range(4)]
        length = sum(x * x for x in turn) ** 0.5
        x, z = 2.2 * (i % side - side / 2), 2.2 * (i // side - side / 2)
        nodes.append({"mesh": 0,
                      "translation": [x + rng.uniform(-0.3, 0.3), rng.uniform(-0.5, 0.5), z + rng.uniform(-0.3, 0.3)],
                      "rotation": [t / length for t in turn],
                      "scale": [rng.uniform(0.5, 1.1) * rng.choice([1, 1, 1, -1]) for _ in range(3)]})
    nodes.append({"camera": 0, "translation": [0, side * 0.8 + 2, side * 1.6 + 4], "rotation": [-math.sin(0.3), 0, 0, math.cos(0.3)]})
    nodes.append({"translation": [side * 0.5, side * 1.5 + 5, side * 0.7], "extensions": {"KHR_lights_punctual": {"light": 0}}})
    text = json.dumps({
        "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"], "scenes": [{"nodes": list(range(len(nodes)))}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 100.0 * side * side}]}},
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}}], "nodes": nodes, "meshes": meshes,
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(binary)}]}).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(binary)) + struct.pack("<II", len(text), 0x4E4F534A) + text +
                     struct.pack("<II", len(binary), 0x004E4942) + binary)


def cost(program, path, frames):
    """Processor seconds and KB."""
    command = [program, "measure", path, "--mode", "raytrace", "--threads", "1", "--size", "320x240", "--frames", str(frames)]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    if status:
        raise SystemExit(f"{command} failed")
    return used.ru_utime + used.ru_stime, used.ru_maxrss


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    print("triangles,copies,program,frame_ms,first_frames_ms,peak_mb")
    with tempfile.TemporaryDirectory() as folder:
        for triangles, copies in CASES:
            path = pathlib.Path(folder) / "grid.glb"
            write_grid(path, triangles, copies)
            runs = {program: [] for program in options.programs}
            for _ in range(options.repeat):
                for program, of in runs.items():
                    few, peak = cost(program, path, 4)
                    of.append((few, cost(program, path, 4 + FRAMES)[0], peak))
            for program, of in runs.items():
                few, many = min(r[0] for r in of), min(r[1] for r in of)
                print(f"{triangles},{copies},{pathlib.Path(program).name},{(many - few) / FRAMES * 1e3:.1f},{few * 1e3:.0f},"
                      f"{min(r[2] for r in of) / 1024:.0f}", flush=True)


if __name__ == "__main__":
    main()
