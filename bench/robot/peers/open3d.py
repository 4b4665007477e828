# needs: numpy open3d==0.19.0
"""Open3D with Filament on software OpenGL (0.20 takes software Vulkan, and hangs), its shadow maps. It has no masks."""
import os

VARIANTS = {"Open3D": {}}
MASKS = False


def frames(job, masks):
    os.environ["EGL_PLATFORM"] = "surfaceless"
    os.environ["LP_NUM_THREADS"] = str(job.threads)
    import numpy
    import open3d

    rendering, vector = open3d.visualization.rendering, open3d.utility
    renderer = rendering.OffscreenRenderer(*job.size)
    for i, (vertices, faces, normals, color) in enumerate(job.parts):
        mesh = open3d.geometry.TriangleMesh(vector.Vector3dVector(vertices), vector.Vector3iVector(faces.astype(numpy.int32)))
        mesh.vertex_normals = vector.Vector3dVector(normals)
        material = rendering.MaterialRecord()
        material.shader, material.base_color = "defaultLit", (*map(float, color), 1.0)
        renderer.scene.add_geometry(f"part {i}", mesh, material)
    for i, place in enumerate(job.lights):
        towards = numpy.subtract(job.target, place).tolist()
        renderer.scene.scene.add_spot_light(str(i), (1, 1, 1), place, towards, 1e5, 50, 0.5, 0.8, True)
    renderer.setup_camera(job.fov, job.target, job.eye, job.up)
    while True:
        for poses in job.poses:
            for i, pose in enumerate(poses[:-1]):
                renderer.scene.set_geometry_transform(f"part {i}", pose)
            color = numpy.asarray(renderer.render_to_image())
            yield 1, {"color": color, "depth": numpy.asarray(renderer.render_to_depth_image(z_in_view_space=True))}
