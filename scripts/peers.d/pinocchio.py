# needs: THIS_TREE
"""The Python module, on the CPU alone: two exact shadows."""
VARIANTS = {"Pinocchio Python": {"many": False}, "Pinocchio render_many": {"many": True}}


def frames(job, many):
    import pinocchio_renderer as pn

    lights = [pn.Light(position=p) for p in job.lights]
    scene = pn.Scene(job.vertices, job.faces, normals=job.normals, lights=lights)
    engine = pn.Engine(threads=job.threads)
    cameras = [pn.Camera.from_pose(job.pose(k), "opengl", job.fov) for k in range(len(job.eyes))]
    out = None
    while many:
        out = engine.render_many(scene, cameras, tuple(job.size), ["color"], out=out)
        yield len(cameras)
    while True:
        for camera in cameras:
            engine.render(scene, camera, size=tuple(job.size)).color
            yield
