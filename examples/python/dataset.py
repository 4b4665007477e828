"""Colour, depth and ids of a scene from random cameras: dataset.py SCENE OUT.npz [PICTURES]"""
import sys
from typing import Any

import numpy
import pinocchio_renderer as pn
from numpy.typing import NDArray

SIZE = (128, 128)
FOCAL = 140.0  # pixels


def random_camera(scene: pn.Scene, random: numpy.random.Generator) -> NDArray[numpy.float64]:
    """The pose of a camera at a random place around the scene that looks at a point near its centre."""
    low, high = map(numpy.array, scene.bounds)
    middle, radius = (low + high) / 2, numpy.linalg.norm(high - low) / 2
    direction = random.normal(size=3)
    direction[1] = abs(direction[1])
    eye = middle + direction / numpy.linalg.norm(direction) * radius * random.uniform(1.5, 3)
    forward = middle + random.uniform(-0.2, 0.2, 3) * radius - eye
    forward /= numpy.linalg.norm(forward)
    right = numpy.cross(forward, (0, 1, 0))
    right /= numpy.linalg.norm(right)
    pose = numpy.eye(4)  # camera to world, OpenCV's axes: x right, y down, z forward
    pose[:3] = numpy.column_stack([right, numpy.cross(forward, right), forward, eye])
    return pose


def main(file: str, out: str, pictures: int = 100) -> None:
    scene, random = pn.load_scene(file), numpy.random.default_rng(0)
    poses = numpy.stack([random_camera(scene, random) for _ in range(pictures)])
    center = (SIZE[0] - 1) / 2, (SIZE[1] - 1) / 2
    cameras = [pn.Camera.from_intrinsics(SIZE, FOCAL, FOCAL, *center, pose) for pose in poses]
    arrays: dict[str, Any] = pn.Engine().render_many(scene, cameras, SIZE, outputs=["color", "depth", "ids", "objects"])
    numpy.savez_compressed(out, poses=poses, focal=FOCAL, center=center, **arrays)
    print(f"{out}: {pictures} pictures of {SIZE[0]}x{SIZE[1]}, poses, colour, depth, ids, objects")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
