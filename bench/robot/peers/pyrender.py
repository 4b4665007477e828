# needs: numpy pyrender
"""pyrender on software OpenGL (EGL), shadow maps of spot lights. Masks are a pass of their own."""
import os

VARIANTS = {"pyrender": {"shadows": True}, "pyrender without shadows": {"shadows": False}}
MASKS = True


def frames(job, masks, shadows):
    os.environ["PYOPENGL_PLATFORM"] = "egl"
    os.environ["LP_NUM_THREADS"] = str(job.threads)
    import numpy

    numpy.infty = numpy.inf  # of older NumPy, which it wants
    import pyrender

    scene = pyrender.Scene(ambient_light=(0.1, 0.1, 0.1))
    nodes = []
    for vertices, faces, normals, color in job.parts:
        material = pyrender.MetallicRoughnessMaterial(baseColorFactor=(*map(float, color), 1.0), metallicFactor=0.0)
        nodes.append(scene.add(pyrender.Mesh([pyrender.Primitive(positions=vertices, normals=normals, indices=faces, material=material)])))
    for pose in map(job.pose_at, job.lights):
        scene.add(pyrender.SpotLight(intensity=40, outerConeAngle=0.8), pose=pose)
    scene.add(pyrender.PerspectiveCamera(numpy.radians(job.fov)), pose=job.pose_at(job.eye))
    renderer = pyrender.OffscreenRenderer(*job.size)
    flags = pyrender.RenderFlags.SHADOWS_SPOT if shadows else pyrender.RenderFlags.NONE
    colors = {node: (i // 256, i % 256, 1) for i, node in enumerate(nodes)}
    while True:
        for poses in job.poses:
            for node, pose in zip(nodes[:-1], poses):
                scene.set_pose(node, pose)
            color, depth = renderer.render(scene, flags=flags)
            arrays = {"color": color, "depth": depth}
            if masks:
                arrays["objects"] = renderer.render(scene, flags=pyrender.RenderFlags.SEG, seg_node_map=colors)[0]
            yield 1, arrays
