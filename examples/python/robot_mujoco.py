"""Colour, depth, masks and motion of a MuJoCo model that moves: robot_mujoco.py MODEL.xml OUT.npz [STEPS]

MuJoCo (pip install mujoco) does the physics. Each geom is a node of the scene, which is put together once; each step
sets poses. Motion leads to the step before. Height fields and textures are left out.
"""
import sys
from typing import Any

import mujoco  # type: ignore[import, unused-ignore]
import numpy
import pinocchio_renderer as pn
import trimesh
from numpy.typing import NDArray

SIZE = (320, 240)
STEP = 0.05  # seconds between two pictures
PLANE = 20.0  # half the side of a plane that the model says is infinite


def shape_of(model: Any, geom: int) -> Any:
    """The mesh of a geom in its own frame, or None."""
    kinds, kind = mujoco.mjtGeom, model.geom_type[geom]
    x, y, z = map(float, model.geom_size[geom])
    create: Any = trimesh.creation
    if kind == kinds.mjGEOM_PLANE:
        return create.box(extents=(2 * (x or PLANE), 2 * (y or PLANE), 1e-3))
    if kind == kinds.mjGEOM_SPHERE:
        return create.icosphere(subdivisions=3, radius=x)
    if kind == kinds.mjGEOM_ELLIPSOID:
        return create.icosphere(subdivisions=3).apply_scale((x, y, z))
    if kind == kinds.mjGEOM_BOX:
        return create.box(extents=(2 * x, 2 * y, 2 * z))
    if kind == kinds.mjGEOM_CYLINDER:
        return create.cylinder(radius=x, height=2 * y)
    if kind == kinds.mjGEOM_CAPSULE:
        capsule = create.capsule(radius=x, height=2 * y)
        return capsule.apply_translation(-capsule.bounds.mean(axis=0))  # the middle is the origin
    if kind == kinds.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        vertex, face = model.mesh_vertadr[mesh], model.mesh_faceadr[mesh]
        return trimesh.Trimesh(model.mesh_vert[vertex : vertex + model.mesh_vertnum[mesh]],
                               model.mesh_face[face : face + model.mesh_facenum[mesh]], process=False)
    return None


def scene_of(model: Any) -> tuple[pn.Scene, dict[str, int]]:
    """The scene, and the geom of each node. The geoms' last groups, which MuJoCo hides, are left out."""
    parts, geoms = {}, {}
    for geom in range(model.ngeom):
        mesh = shape_of(model, geom) if model.geom_group[geom] < 3 else None
        if mesh is None:
            continue
        name = model.geom(geom).name or f"geom {geom}"
        red, green, blue = (float(c) ** 2.2 for c in model.geom_rgba[geom][:3])
        smooth = model.geom_type[geom] not in (mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_CYLINDER)
        parts[name] = pn.from_trimesh(mesh, smooth=smooth, material=pn.Material(diffuse=(red, green, blue)))
        geoms[name] = geom
    scene = pn.assemble(parts)
    scene.lights = [pn.Light(direction=(-0.5, 0.3, -1)), pn.Light(direction=(1, 1, -1), intensity=0.3)]
    return scene, geoms


def pose_of(data: Any, geom: int) -> NDArray[numpy.float64]:
    pose = numpy.eye(4)
    pose[:3, :3], pose[:3, 3] = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
    return pose


def main(file: str, out: str, steps: int = 10) -> None:
    model: Any = mujoco.MjModel.from_xml_path(file)
    data: Any = mujoco.MjData(model)
    scene, geoms = scene_of(model)
    middle, size = numpy.array(model.stat.center), float(model.stat.extent)
    camera = pn.Camera(eye=middle + size * numpy.array([1.3, -1.3, 0.9]), target=middle, up=(0, 0, 1), fov=45)
    pictures, before = [], None
    mujoco.mj_forward(model, data)
    with pn.Engine() as engine:
        for step in range(steps):
            while data.time < step * STEP:
                mujoco.mj_step(model, data)
            posed = scene.posed({name: pose_of(data, geom) for name, geom in geoms.items()})
            picture = engine.render(posed, camera, size=SIZE, spp=4)
            pictures.append((picture.color, picture.depth, picture.objects, picture.motion(scene=before or posed)))
            before = posed
    color, depth, objects, motion = map(numpy.stack, zip(*pictures))
    numpy.savez_compressed(out, color=color, depth=depth, objects=objects, motion=motion, names=numpy.array(scene.nodes))
    print(f"{out}: {steps} steps of {len(scene.nodes)} geoms")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
