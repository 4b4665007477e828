# needs: numpy THIS_TREE
"""The Python module, on the CPU alone: two exact shadows. One by one, and many poses in one call."""
VARIANTS = {"Pinocchio render": {"many": False}, "Pinocchio render_many": {"many": True}}
MASKS = True


def frames(job, masks, many):
    import pinocchio_renderer as pn

    parts = {}
    for i, (vertices, faces, normals, color) in enumerate(job.parts):
        parts[f"part {i}"] = pn.Scene(vertices, faces, normals=normals, materials=pn.Material(diffuse=tuple(map(float, color))))
    scene = pn.assemble(parts)
    scene.lights = [pn.Light(position=place) for place in job.lights]
    camera = pn.Camera(job.eye, job.target, up=job.up, fov=job.fov)
    engine = pn.Engine(threads=job.threads)
    outputs = ["color", "depth"] + ["objects"] * masks
    poses = [{name: job.poses[k, i] for i, name in enumerate(list(parts)[:-1])} for k in range(len(job.poses))]
    out = None
    while many:
        out = engine.render_many(scene, [camera], job.size, outputs=outputs, poses=poses, out=out)
        yield len(poses), {name: array[0] for name, array in out.items()}
    while True:
        for pose in poses:
            picture = engine.render(scene.posed(pose), camera, size=job.size)
            yield 1, {name: getattr(picture, name) for name in outputs}
