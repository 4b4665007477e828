# needs: numpy pyrender
"""pyrender on software OpenGL; shadow maps only of spot lights."""
import os

VARIANTS = {"pyrender without shadows": {"shadows": False}, "pyrender": {"shadows": True}}


def frames(job, shadows):
    os.environ["PYOPENGL_PLATFORM"] = "egl"
    os.environ["LP_NUM_THREADS"] = str(job.threads)
    import numpy

    numpy.infty = numpy.inf  # of older NumPy, which it wants
    import pyrender

    scene = pyrender.Scene(ambient_light=(0.1, 0.1, 0.1))
    scene.add(pyrender.Mesh([pyrender.Primitive(positions=job.vertices, normals=job.normals, indices=job.faces)]))
    for p in job.lights:
        towards = numpy.subtract(p, job.target)
        z = towards / numpy.linalg.norm(towards)
        x = numpy.cross((0, 1, 0), z)
        x /= numpy.linalg.norm(x)
        pose = numpy.eye(4)
        pose[:3] = numpy.column_stack([x, numpy.cross(z, x), z, p])
        scene.add(pyrender.SpotLight(intensity=60 * job.radius ** 2, outerConeAngle=0.6), pose=pose)
    camera = scene.add(pyrender.PerspectiveCamera(numpy.radians(job.fov)))
    renderer = pyrender.OffscreenRenderer(*job.size)
    flags = pyrender.RenderFlags.SHADOWS_SPOT if shadows else pyrender.RenderFlags.NONE
    for k in range(10 ** 9):
        scene.set_pose(camera, job.pose(k))
        renderer.render(scene, flags=flags)
        yield
