"""Rays a second of one thread, ours and Embree's by embreex (what trimesh takes), in one process and in turns.

Needs the module, trimesh and embreex: beside_embreex.py [RAYS]. A lidar's rays go row by row from one place above a bumpy
ball; random ones go from a sphere around it to points near it, in any order. Both find the nearest triangle. Times
are of the processor, medians of nine.
"""
import statistics
import sys
import time

import numpy
import pinocchio_renderer as pn
import trimesh
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh


def random_rays(rays):
    random = numpy.random.default_rng(1)
    origins = random.normal(size=(rays, 3))
    origins *= 3 / numpy.linalg.norm(origins, axis=1)[:, None]
    return origins, random.uniform(-0.8, 0.8, (rays, 3)) - origins


def lidar_rays(rays):
    rows = int(rays**0.5)
    turn, rise = numpy.meshgrid(numpy.linspace(-0.4, 0.4, rows), numpy.linspace(-0.4, 0.4, rows))
    directions = numpy.stack([numpy.sin(turn), numpy.sin(rise), -numpy.cos(turn) * numpy.cos(rise)], -1).reshape(-1, 3)
    return numpy.tile([[0.0, 0.0, 3.0]], (len(directions), 1)), directions


def main(rays: int = 200_000) -> None:
    for subdivisions in (3, 6):
        mesh = trimesh.creation.icosphere(subdivisions=subdivisions)
        mesh.vertices *= 1 + 0.05 * numpy.sin(9 * mesh.vertices).prod(axis=1)[:, None]
        scene = rtcore_scene.EmbreeScene()
        TriangleMesh(scene, mesh.triangles.astype(numpy.float32))
        tracer = pn.Tracer(mesh.vertices, mesh.faces, threads=1)
        for kind, made in (("lidar", lidar_rays(rays)), ("random", random_rays(rays))):
            measure(f"{len(mesh.faces)} triangles, {kind}", scene, tracer, *(array.astype(numpy.float32) for array in made))


def measure(what, scene, tracer, origins, directions):
    calls = {"embreex": lambda: scene.run(origins, directions), "ours": lambda: tracer.closest_hits(origins, directions).triangle}
    times: dict[str, list[float]] = {name: [] for name in calls}
    hits = {}
    for _ in range(9):
        for name, call in calls.items():
            begin = time.process_time()
            hits[name] = numpy.asarray(call()).astype(numpy.int64)
            times[name].append(time.process_time() - begin)
    ours = numpy.where(hits["ours"] == 0xFFFFFFFF, -1, hits["ours"])
    speeds = {name: len(origins) / statistics.median(of) / 1e6 for name, of in times.items()}
    print(f"{what}: " + ", ".join(f"{name} {speed:.2f}" for name, speed in speeds.items()), "million rays/s,",
          f"{(ours != hits['embreex']).sum()} of {len(origins)} rays hit another triangle")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
