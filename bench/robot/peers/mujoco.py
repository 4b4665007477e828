# needs: numpy mujoco
"""MuJoCo's renderer on software OpenGL (EGL), with its shadow maps. Depth and masks are passes of their own."""
import os

VARIANTS = {"MuJoCo": {}}
MASKS = True


def quaternion(rotation):
    import mujoco
    import numpy

    q = numpy.empty(4)
    mujoco.mju_mat2Quat(q, numpy.ascontiguousarray(rotation, float).ravel())
    return q


def model_of(job):
    """The parts as bodies whose poses are given, not computed."""
    import mujoco
    import numpy

    spec = mujoco.MjSpec()
    spec.visual.global_.offwidth, spec.visual.global_.offheight = job.size
    for i, (vertices, faces, normals, color) in enumerate(job.parts):
        spec.add_mesh(name=f"mesh {i}", uservert=vertices.ravel().tolist(), userface=faces.ravel().astype(int).tolist(),
                      usernormal=normals.ravel().tolist(), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
        body = spec.worldbody.add_body(name=f"part {i}", mocap=i + 1 < len(job.parts))
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=f"mesh {i}", rgba=(*map(float, color), 1.0), contype=0, conaffinity=0)
    for place in job.lights:
        spec.worldbody.add_light(pos=place, dir=numpy.subtract(job.target, place).tolist(), castshadow=True)
    pose = job.pose_at(job.eye)
    spec.worldbody.add_camera(name="eye", pos=pose[:3, 3].tolist(), quat=quaternion(pose[:3, :3]).tolist(), fovy=job.fov)
    return spec.compile()


def frames(job, masks):
    os.environ["MUJOCO_GL"] = "egl"
    os.environ["LP_NUM_THREADS"] = str(job.threads)
    import mujoco
    import numpy

    model = model_of(job)
    data = mujoco.MjData(model)
    quaternions = numpy.array([[quaternion(pose[:3, :3]) for pose in poses[:-1]] for poses in job.poses])
    renderer = mujoco.Renderer(model, job.size[1], job.size[0])
    while True:
        for poses, turns in zip(job.poses, quaternions):
            data.mocap_pos[:], data.mocap_quat[:] = poses[:-1, :3, 3], turns
            mujoco.mj_kinematics(model, data)
            mujoco.mj_camlight(model, data)
            renderer.update_scene(data, "eye")
            arrays = {"color": renderer.render()}
            renderer.enable_depth_rendering()
            arrays["depth"] = renderer.render()
            renderer.disable_depth_rendering()
            if masks:
                renderer.enable_segmentation_rendering()
                arrays["objects"] = renderer.render()[..., 0]
                renderer.disable_segmentation_rendering()
            yield 1, arrays
