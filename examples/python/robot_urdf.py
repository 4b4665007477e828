"""Colour, depth, masks and motion of a robot that moves: robot_urdf.py ROBOT.urdf OUT.npz [STEPS]

Reads URDF with yourdfpy (pip install yourdfpy). The scene is put together once; each step is a set of poses. Every joint
that moves goes from its lower to its upper limit. All steps are drawn in one call; motion leads to the next one.
"""
import sys
from typing import Any

import numpy
import pinocchio_renderer as pn
import yourdfpy  # type: ignore[import, unused-ignore]
from numpy.typing import NDArray

SIZE = (320, 240)


def poses_of(robot: Any) -> dict[str, NDArray[numpy.float64]]:
    """The pose of each node with a mesh, to the robot's base."""
    return {node: robot.scene.graph[node][0] for node in robot.scene.graph.nodes_geometry}


def camera_of(scene: pn.Scene) -> pn.Camera:
    """The robot from the front and the left, with z upwards."""
    low, high = map(numpy.array, scene.bounds)
    middle, size = (low + high) / 2, float(numpy.linalg.norm(high - low))
    return pn.Camera(eye=middle + size * numpy.array([1.3, 0.9, 0.7]), target=middle, up=(0, 0, 1), fov=45)


def main(file: str, out: str, steps: int = 10) -> None:
    robot: Any = yourdfpy.URDF.load(file)
    lights = [pn.Light(direction=(-1, -0.5, -2)), pn.Light(direction=(-0.5, 1, -0.3), intensity=0.3)]
    scene = pn.from_trimesh(robot.scene, smooth=False, lights=lights)
    poses = []
    for part in numpy.linspace(0, 1, steps):
        limits = [joint.limit for joint in robot.actuated_joints]
        robot.update_cfg([low + part * (high - low) for low, high in
                          ((-numpy.pi, numpy.pi) if limit is None or limit.lower is None else (limit.lower, limit.upper)
                           for limit in limits)])
        poses.append(poses_of(robot))
    with pn.Engine() as engine:
        arrays: dict[str, Any] = engine.render_many(scene, [camera_of(scene)], SIZE, poses=poses, spp=4,
                                                    outputs=["color", "depth", "objects", "motion"])
    numpy.savez_compressed(out, names=numpy.array(scene.nodes), **arrays)
    print(f"{out}: {steps} steps of {len(scene.nodes)} nodes")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
