# needs: bpy==4.2.0
"""Blender's Cycles on the CPU: one sample, direct light."""
VARIANTS = {"Cycles": {}}


def frames(job):
    import bpy
    import mathutils
    import numpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    data = bpy.data.meshes.new("mesh")
    data.from_pydata(job.vertices.tolist(), [], job.faces.tolist())
    bpy.context.collection.objects.link(bpy.data.objects.new("mesh", data))
    for p in job.lights:
        light = bpy.data.objects.new("light", bpy.data.lights.new("light", "POINT"))
        light.data.energy, light.location = 1000 * job.radius ** 2, p
        bpy.context.collection.objects.link(light)
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "VERTICAL", numpy.radians(job.fov)
    at = bpy.data.objects.new("camera", camera)
    bpy.context.collection.objects.link(at)
    scene = bpy.context.scene
    scene.camera, scene.render.engine, scene.cycles.samples = at, "CYCLES", 1
    scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = False, False
    scene.cycles.max_bounces, scene.render.use_persistent_data = 1, True
    scene.render.threads_mode, scene.render.threads = "FIXED", job.threads
    scene.render.resolution_x, scene.render.resolution_y = job.size
    for k in range(10 ** 9):
        at.matrix_world = mathutils.Matrix(job.pose(k).tolist())
        bpy.ops.render.render()
        yield
