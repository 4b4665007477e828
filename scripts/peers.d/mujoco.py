# needs: numpy mujoco
"""MuJoCo's renderer on software OpenGL, with its shadow maps."""
import os

VARIANTS = {"MuJoCo": {}}


def frames(job):
    os.environ["MUJOCO_GL"] = "egl"
    os.environ["LP_NUM_THREADS"] = str(job.threads)
    import mujoco
    import numpy

    spec = mujoco.MjSpec()
    spec.add_mesh(name="mesh", uservert=job.vertices.ravel().tolist(), userface=job.faces.ravel().astype(int).tolist(),
                  usernormal=job.normals.ravel().tolist(), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
    spec.visual.global_.fovy = job.fov
    spec.visual.global_.offwidth, spec.visual.global_.offheight = job.size
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="mesh")
    for p in job.lights:
        spec.worldbody.add_light(pos=p, dir=numpy.subtract(job.target, p).tolist(), castshadow=True)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    renderer = mujoco.Renderer(model, job.size[1], job.size[0])
    camera = mujoco.MjvCamera()
    camera.distance, camera.lookat[:] = 3.35 * job.radius, job.target
    for k in range(10 ** 9):
        camera.azimuth, camera.elevation = 360 / len(job.eyes) * k, -17
        renderer.update_scene(data, camera)
        renderer.render()
        yield
