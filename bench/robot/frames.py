#!/usr/bin/env python3
"""Draws a robot that moves, in each frame another pose, with Pinocchio and with what simulators draw with.

bench/robot/frames.py [--urdf FILE] [--size WxH] [--frames N] [--rounds N] [--threads N] [--only NAME,NAME]
                      [--module WHEEL] [--docs]

The robot is Franka Emika's Panda from PyPI's example-robot-data, read by yourdfpy: each mesh of a link is a part, which
has a pose of its own in each frame, on a floor that stands still, under two lights that cast shadows. Every renderer gets
the same arrays, poses and camera and gives colour and depth, then colour, depth and masks, as NumPy arrays. Each draws
in a process of its own; processes take turns for ROUNDS rounds, and a time is the median of the rounds' medians, by the clock
and of all processors together (which other programs beside it disturb less). The depth of one frame is compared with ours: the
share of pixels within 1 %.

Python packages go to environments of their own under build/peers, as scripts/peers has them; the module comes from this
tree, or from WHEEL. --docs writes the table into docs/measurements.md.
"""
import argparse
import ast
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PEERS = pathlib.Path(__file__).parent / "peers"
PAGE = ROOT / "docs/measurements.md"
WARM_UP = 5  # frames
PATIENCE_S = 600  # with a peer that hangs
POSES = 60  # then from the beginning
FOV = 40.0  # vertical, degrees
EYE, TARGET = (1.6, -1.3, 1.2), (0.15, 0.0, 0.5)
LIGHTS = ((1.5, -1.0, 2.5), (0.8, 1.8, 1.8))
ROBOT = "panda_description/urdf/panda.urdf"


def shared():
    """scripts/peers, whose environments are used here."""
    loader = importlib.machinery.SourceFileLoader("shared_peers", str(ROOT / "scripts/peers"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("shared_peers", loader))
    loader.exec_module(module)
    module.WORK.mkdir(parents=True, exist_ok=True)
    return module


class Job:
    """The robot as all programs draw it: parts (vertices, faces, normals, color), and poses of shape (frames, parts, 4, 4). z points up."""

    def __init__(self, file, size, threads):
        import numpy

        arrays = numpy.load(file)
        self.size, self.threads, self.fov, self.lights = size, threads, FOV, LIGHTS
        self.eye, self.target, self.up = EYE, TARGET, (0.0, 0.0, 1.0)
        self.poses, colors = arrays["poses"], arrays["colors"]
        self.parts = [(arrays[f"vertices{i}"], arrays[f"faces{i}"], arrays[f"normals{i}"], colors[i]) for i in range(len(colors))]

    def pose_at(self, place):
        """What stands at `place` and looks at the target, to world: OpenGL's axes (it looks along -z)."""
        import numpy

        back = numpy.subtract(place, self.target) / numpy.linalg.norm(numpy.subtract(place, self.target))
        right = numpy.cross(self.up, back) / numpy.linalg.norm(numpy.cross(self.up, back))
        pose = numpy.eye(4)
        pose[:3] = numpy.column_stack([right, numpy.cross(back, right), back, place])
        return pose


def prepare(file, urdf):
    """In an environment with yourdfpy: the robot as arrays. Its joints swing between their limits."""
    import numpy
    import trimesh
    import yourdfpy

    share = next(pathlib.Path(sys.prefix).glob("lib/python3*/site-packages/cmeel.prefix/share/example-robot-data/robots"), None)
    path = pathlib.Path(urdf) if urdf else share / ROBOT
    robot = yourdfpy.URDF.load(str(path))
    nodes = sorted(robot.scene.graph.nodes_geometry)
    floor = trimesh.creation.box(extents=(3, 3, 0.02)).apply_translation((0, 0, -0.01))
    meshes = [robot.scene.geometry[robot.scene.graph[node][1]] for node in nodes] + [floor]
    colors = [color_of(mesh) for mesh in meshes[:-1]] + [(0.6, 0.6, 0.6)]
    limits = [joint.limit for joint in robot.actuated_joints]
    low = numpy.array([limit.lower if limit else -3.0 for limit in limits])
    high = numpy.array([limit.upper if limit else 3.0 for limit in limits])
    poses = numpy.tile(numpy.eye(4), (POSES, len(meshes), 1, 1))
    for k in range(POSES):
        turn = 2 * numpy.pi * k / POSES + numpy.arange(len(limits))  # each joint at its own time
        robot.update_cfg(0.5 * (low + high) + 0.35 * (high - low) * numpy.sin(turn))
        poses[k, :-1] = [robot.scene.graph[node][0] for node in nodes]
    arrays = {"poses": poses, "colors": numpy.array(colors, numpy.float32)}
    for i, mesh in enumerate(meshes):
        arrays[f"vertices{i}"] = mesh.vertices.astype(numpy.float32)
        arrays[f"faces{i}"] = mesh.faces.astype(numpy.uint32)
        arrays[f"normals{i}"] = mesh.vertex_normals.astype(numpy.float32)
    numpy.savez(file, **arrays)
    print(f"{path.stem}: {len(meshes)} parts, {sum(len(mesh.faces) for mesh in meshes)} triangles", file=sys.stderr)


def color_of(mesh):
    """One linear colour a part."""
    import numpy

    main = numpy.asarray(getattr(mesh.visual, "material", mesh.visual).main_color)[:3] / 255
    return tuple(numpy.where(main <= 0.04045, main / 12.92, ((main + 0.055) / 1.055) ** 2.4))


def load_peer(script):
    spec = importlib.util.spec_from_file_location("peer", script)
    peer = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(peer)
    return peer


def draw(script, file, out, size, threads, masks, count, arguments):
    """Within a peer's process: the medians of `count` frames after the warm-up, and the arrays of frame 0."""
    import numpy

    job = Job(file, ast.literal_eval(size), int(threads))
    frames = load_peer(script).frames(job, masks == "masks", **ast.literal_eval(arguments))
    times, first, drawn = [], None, 0
    while len(times) < 3 or drawn < int(count):
        begin = time.perf_counter(), time.process_time()
        batch, arrays = next(frames)  # how many frames, and the first one's arrays
        took = [1e3 * (now - then) / batch for now, then in zip((time.perf_counter(), time.process_time()), begin)]
        if first is None:
            first = {name: numpy.array(array) for name, array in arrays.items()}
            numpy.savez(out, **first)
        drawn += batch
        if drawn > WARM_UP and drawn > batch:
            times.append(took)
    print(json.dumps({kind: statistics.median(of) for kind, of in zip(("wall", "processor"), zip(*times))}), flush=True)
    os._exit(0)  # some do not survive their end


def variants():
    """name -> (script, arguments, whether it has masks)"""
    found = {}
    for script in sorted(PEERS.glob("*.py")):
        peer = load_peer(script)
        for name, arguments in peer.VARIANTS.items():
            found[name] = script, arguments, peer.MASKS
    return found


def measured(options, environment_of, file):
    """name -> {"plain": [times], "masks": [times]}; one process each, in turns."""
    results = {}
    for turn in range(options.rounds):
        for name, (script, arguments, has_masks) in variants().items():
            if options.only and name not in options.only.split(","):
                continue
            for kind in ("plain", "masks") if has_masks else ("plain",):
                out = file.with_name(f"robot-{script.stem}-{kind}.npz")
                command = [environment_of(script), __file__, "--draw", script, file, out, repr(options.size), str(options.threads), kind,
                           str(options.frames), repr(arguments)]
                try:
                    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S)
                except subprocess.TimeoutExpired:
                    print(f"{name}, {kind}: left out: no end after {PATIENCE_S} s", file=sys.stderr)
                    continue
                if not done.stdout.strip():
                    print(f"{name}, {kind}: left out: {done.stderr.strip().splitlines()[-1:]}", file=sys.stderr)
                    continue
                times = json.loads(done.stdout.splitlines()[-1])
                results.setdefault(name, {}).setdefault(kind, []).append(times)
                print(f"round {turn}: {name}, {kind}: {times['wall']:.1f} ms, {times['processor']:.1f} of processors", file=sys.stderr)
    return results


def agreement(file, script):
    """The share of pixels whose depth is ours, within 1 %."""
    import numpy

    ours, theirs = (numpy.load(file.with_name(f"robot-{stem}-plain.npz"))["depth"].squeeze() for stem in ("pinocchio", script.stem))
    theirs = numpy.where((theirs <= 0) | (theirs > 50), numpy.inf, theirs)  # what nothing is seen at is 0, or the far plane
    with numpy.errstate(invalid="ignore"):
        same = (numpy.abs(theirs - ours) <= 0.01 * numpy.abs(ours)) | (numpy.isinf(ours) & numpy.isinf(theirs))
    return same.mean()


def table(results, file):
    lines = ["| | colour, depth: ms of processors | frames/s of a processor | with masks: ms | frames/s | clock, ms | depth as ours |",
             "|---|---:|---:|---:|---:|---:|---:|"]
    for name, times in results.items():
        cells = []
        for kind in ("plain", "masks"):
            ms = statistics.median(one["processor"] for one in times[kind]) if kind in times else None
            cells += [f"{ms:.3g}", f"{1e3 / ms:.3g}"] if ms else ["", ""]
        cells.append(", ".join(f"{statistics.median(one['wall'] for one in of):.0f}" for of in times.values()))
        cells.append("" if name.startswith("Pinocchio") else f"{100 * agreement(file, variants()[name][0]):.2f} %")
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def write_docs(text):
    pattern = re.compile(r"(<!-- begin robot -->\n).*?(<!-- end robot -->)", re.S)
    PAGE.write_text(pattern.sub(lambda m: m.group(1) + text + "\n" + m.group(2), PAGE.read_text(encoding="utf-8")), encoding="utf-8")


def main():
    if sys.argv[1:2] == ["--draw"]:
        return draw(*sys.argv[2:])
    if sys.argv[1:2] == ["--prepare"]:
        return prepare(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--urdf", default="")
    parser.add_argument("--size", default="256x256", type=lambda text: tuple(int(n) for n in text.split("x")))
    parser.add_argument("--frames", type=int, default=60, help="of each renderer in a round")
    parser.add_argument("--rounds", type=int, default=5, help="0: the table of the last run")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only", default="")
    parser.add_argument("--module", default="THIS_TREE", help="a wheel of the module")
    parser.add_argument("--docs", action="store_true")
    options = parser.parse_args()
    peers = shared()
    peers.enter_environment()  # goes on where NumPy is

    def environment_of(script):
        needs = re.match(r"# needs: (.*)", script.read_text()).group(1)
        module = str(ROOT) if options.module == "THIS_TREE" else options.module
        return peers.environment(script.stem, *needs.replace("THIS_TREE", module).split())

    file = peers.WORK / "robot.npz"
    if options.rounds == 0:  # the table of what was measured before
        text = table(json.loads((peers.WORK / "robot.json").read_text()), file)
        print(text)
        return write_docs(text) if options.docs else None
    reader = peers.environment("urdf", "yourdfpy", "example-robot-data==6.0.0")
    subprocess.run([reader, __file__, "--prepare", file, options.urdf], check=True)
    results = measured(options, environment_of, file)
    (peers.WORK / "robot.json").write_text(json.dumps(results, indent=1) + "\n")
    text = table(results, file)
    print(text)
    if options.docs:
        write_docs(text)


if __name__ == "__main__":
    main()
