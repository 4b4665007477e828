"""Rays a second of one thread, ours and Embree's by embreex (what trimesh takes), in one process and in turns.

Needs the module, trimesh and embreex: beside_embreex.py [RAYS]. Rays go from a sphere around a bumpy ball to points near it,
in random order; the nearest hit's triangle is asked for. Times are of the processor, medians of nine.
"""
import statistics
import sys
import time

import numpy
import pinocchio_renderer as pn
import trimesh
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh


def main(rays: int = 200_000) -> None:
    for subdivisions in (3, 6):
        mesh = trimesh.creation.icosphere(subdivisions=subdivisions)
        mesh.vertices *= 1 + 0.05 * numpy.sin(9 * mesh.vertices).prod(axis=1)[:, None]
        random = numpy.random.default_rng(1)
        origins = random.normal(size=(rays, 3))
        origins *= 3 / numpy.linalg.norm(origins, axis=1)[:, None]
        directions = random.uniform(-0.8, 0.8, (rays, 3)) - origins
        origins, directions = origins.astype(numpy.float32), directions.astype(numpy.float32)
        scene = rtcore_scene.EmbreeScene()
        TriangleMesh(scene, mesh.triangles.astype(numpy.float32))
        tracer = pn.Tracer(mesh.vertices, mesh.faces, threads=1)
        calls = {"embreex": lambda: scene.run(origins, directions), "ours": lambda: tracer.closest_hits(origins, directions).triangle}
        times: dict[str, list[float]] = {name: [] for name in calls}
        hits = {}
        for _ in range(9):
            for name, call in calls.items():
                begin = time.process_time()
                hits[name] = numpy.asarray(call()).astype(numpy.int64)
                times[name].append(time.process_time() - begin)
        ours = numpy.where(hits["ours"] == 0xFFFFFFFF, -1, hits["ours"])
        speeds = {name: rays / statistics.median(of) / 1e6 for name, of in times.items()}
        print(f"{len(mesh.faces)} triangles: " + ", ".join(f"{name} {speed:.2f} million rays/s" for name, speed in speeds.items()),
              f"({(ours != hits['embreex']).mean():.6f} of the rays hit another triangle)")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
