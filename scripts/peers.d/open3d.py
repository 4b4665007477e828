# needs: numpy open3d==0.19.0
"""Open3D with Filament on software OpenGL (0.20 takes software Vulkan, and hangs): two lights, its shadow maps."""
import os

VARIANTS = {"Open3D": {}}


def frames(job):
    os.environ["EGL_PLATFORM"] = "surfaceless"
    os.environ["LP_NUM_THREADS"] = str(job.threads)
    import numpy
    import open3d

    vector = open3d.utility
    mesh = open3d.geometry.TriangleMesh(vector.Vector3dVector(job.vertices), vector.Vector3iVector(job.faces.astype(numpy.int32)))
    mesh.vertex_normals = vector.Vector3dVector(job.normals)
    rendering = open3d.visualization.rendering
    renderer = rendering.OffscreenRenderer(*job.size)
    material = rendering.MaterialRecord()
    material.shader = "defaultLit"
    renderer.scene.add_geometry("mesh", mesh, material)
    for i, p in enumerate(job.lights):
        towards = numpy.subtract(job.target, p).tolist()
        renderer.scene.scene.add_spot_light(str(i), (1, 1, 1), p, towards, 1e5, 50 * job.radius, 0.5, 0.6, True)
    for k in range(10 ** 9):
        renderer.setup_camera(job.fov, job.target, job.eyes[k % len(job.eyes)], (0, 1, 0))
        numpy.asarray(renderer.render_to_image())
        yield
