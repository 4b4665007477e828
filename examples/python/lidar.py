"""A lidar's points of a scene: lidar.py SCENE OUT.npz [NODE]

The sensor turns about the upward axis and fires a fan of beams at each step, from the middle of the scene or from the
node called NODE. Each point has its distance, its node and how much light comes back.
"""
import sys
from typing import Any

import numpy
import pinocchio_renderer as pn
from numpy.typing import NDArray

BEAMS = numpy.radians(numpy.linspace(-25, 15, 32))  # above the horizon
STEPS = numpy.radians(numpy.arange(0, 360, 0.4))
RANGE = 120.0  # scene units
NOISE = 0.01  # standard deviation of a distance, scene units


def beam_pattern() -> NDArray[numpy.float64]:
    """Unit directions, (steps * beams, 3): the sensor looks along -Z at step 0 and turns to the left."""
    turn, rise = (angles.ravel() for angles in numpy.meshgrid(STEPS, BEAMS, indexing="ij"))
    return numpy.stack([-numpy.sin(turn) * numpy.cos(rise), numpy.sin(rise), -numpy.cos(turn) * numpy.cos(rise)], axis=1)


def scan(tracer: pn.Tracer, place: NDArray[numpy.float64], random: numpy.random.Generator) -> dict[str, Any]:
    """The points that the beams hit from `place`: position, distance, node, triangle and intensity."""
    beams = beam_pattern()
    hits = tracer.closest_hits(place[None], beams, numpy.full(len(beams), RANGE))
    seen = numpy.isfinite(hits.t)
    distance = hits.distance[seen] + random.normal(0, NOISE, seen.sum())
    towards = -numpy.einsum("ni,ni->n", beams[seen], hits.triangle_normal[seen])  # the cosine at the surface
    return {
        "position": place + distance[:, None] * beams[seen],
        "distance": distance,
        "node": hits.node[seen],
        "triangle": hits.triangle[seen],
        "intensity": towards / numpy.maximum(distance, 1) ** 2,
    }


def main(file: str, out: str, node: str = "") -> None:
    scene = pn.load_scene(file)
    vertices = scene.vertices
    if node:
        vertices = vertices[scene.triangles[scene.triangle_nodes == scene.nodes.index(node)].ravel()]
    place = (vertices.min(axis=0) + vertices.max(axis=0)).astype(numpy.float64) / 2
    points = scan(pn.Tracer(scene), place, numpy.random.default_rng(0))
    numpy.savez_compressed(out, sensor=place, names=numpy.array(scene.nodes), **points)
    print(f"{out}: {len(points['distance'])} points of {len(STEPS) * len(BEAMS)} beams")


if __name__ == "__main__":
    main(*sys.argv[1:])
