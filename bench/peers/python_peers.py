"""Frames a second of this module beside other renderers that people use from Python without a GPU.

    python_peers.py RESULTS.json [--only PEER] [--triangles N ...] [--seconds S]
    python_peers.py RESULTS.json --table

One bumpy ball, two lights, a camera that goes round it: the same mesh, view and threads for all; each peer in a process
of its own. A frame is timed from the call to the pixels in NumPy. What is not installed is left out.
"""
import argparse
import json
import os
import subprocess
import sys
import time

import numpy

SIZES = [(64, 64), (256, 256), (800, 600)]
TRIANGLES = [1000, 100_000, 1_000_000]
LIGHTS = [(4.0, 5.0, 3.0), (-5.0, 3.0, 2.0)]
FOV = 40.0


def ball(triangles):
    """Vertices, triangles and normals of a bumpy ball of about that many triangles."""
    rows = max(4, int((triangles / 4) ** 0.5))
    u, v = numpy.meshgrid(numpy.linspace(0, 2 * numpy.pi, 2 * rows + 1), numpy.linspace(0.01, numpy.pi - 0.01, rows + 1))
    radius = 1 + 0.05 * numpy.sin(9 * u) * numpy.sin(7 * v)
    points = radius[..., None] * numpy.stack([numpy.cos(u) * numpy.sin(v), numpy.cos(v), numpy.sin(u) * numpy.sin(v)], -1)
    i = (numpy.arange(rows)[:, None] * (2 * rows + 1) + numpy.arange(2 * rows)).ravel()
    j = i + 2 * rows + 1
    faces = numpy.concatenate([numpy.stack([i, i + 1, j], 1), numpy.stack([i + 1, j + 1, j], 1)])
    points = points.reshape(-1, 3)
    normals = points / numpy.linalg.norm(points, axis=1, keepdims=True)
    return points.astype(numpy.float32), faces.astype(numpy.uint32), normals.astype(numpy.float32)


def pose(k):
    """Camera to world, OpenGL's axes: looks along -z."""
    a = 0.05 * k
    eye = numpy.array([3.2 * numpy.sin(a), 1.0, 3.2 * numpy.cos(a)])
    back = eye / numpy.linalg.norm(eye)
    right = numpy.cross((0, 1, 0), back)
    right /= numpy.linalg.norm(right)
    m = numpy.eye(4)
    m[:3] = numpy.column_stack([right, numpy.cross(back, right), back, eye])
    return m


class Pinocchio:
    """render_many: two exact shadows."""

    def __init__(self, mesh, threads):
        import pinocchio

        lights = [pinocchio.Light(position=p) for p in LIGHTS]
        self.of = pinocchio
        self.scene = pinocchio.Scene(mesh[0], mesh[1], normals=mesh[2], lights=lights)
        self.engine = pinocchio.Engine(threads=threads)

    def frames(self, size, first, count):
        cameras = [self.of.Camera.from_pose(pose(first + k), "opengl", FOV) for k in range(count)]
        self.arrays = self.engine.render_many(self.scene, cameras, size, ["color"])["color"]


class PinocchioOne(Pinocchio):
    """The same, a call a frame."""

    def frames(self, size, first, count):
        for k in range(count):
            self.engine.render(self.scene, self.of.Camera.from_pose(pose(first + k), "opengl", FOV), size=size).color


class Pyrender:
    shadows = False

    def __init__(self, mesh, threads):
        os.environ["PYOPENGL_PLATFORM"] = "egl"
        os.environ["LP_NUM_THREADS"] = str(threads)
        numpy.infty = numpy.inf  # of older NumPy, which it wants
        import pyrender

        self.of = pyrender
        self.scene = pyrender.Scene(ambient_light=(0.1, 0.1, 0.1))
        primitive = pyrender.Primitive(positions=mesh[0], normals=mesh[2], indices=mesh[1])
        self.scene.add(pyrender.Mesh([primitive]))
        for p in LIGHTS:
            at = numpy.eye(4)
            z = numpy.array(p) / numpy.linalg.norm(p)
            x = numpy.cross((0, 1, 0), z)
            x /= numpy.linalg.norm(x)
            at[:3] = numpy.column_stack([x, numpy.cross(z, x), z, p])
            self.scene.add(pyrender.SpotLight(intensity=60, outerConeAngle=0.6), pose=at)
        self.camera = self.scene.add(pyrender.PerspectiveCamera(numpy.radians(FOV)))
        self.renderer, self.size = None, None

    def frames(self, size, first, count):
        if self.size != size:
            if self.renderer:
                self.renderer.delete()
            self.renderer, self.size = self.of.OffscreenRenderer(*size), size
        flags = self.of.RenderFlags.SHADOWS_SPOT if self.shadows else self.of.RenderFlags.NONE
        for k in range(count):
            self.scene.set_pose(self.camera, pose(first + k))
            self.renderer.render(self.scene, flags=flags)


class PyrenderShadows(Pyrender):
    shadows = True


class Mujoco:
    def __init__(self, mesh, threads):
        os.environ["MUJOCO_GL"] = "egl"
        os.environ["LP_NUM_THREADS"] = str(threads)
        import mujoco

        spec = mujoco.MjSpec()
        spec.add_mesh(name="ball", uservert=mesh[0].ravel().tolist(), userface=mesh[1].ravel().astype(int).tolist(),
                      usernormal=mesh[2].ravel().tolist(), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
        spec.visual.global_.fovy = FOV
        spec.visual.global_.offwidth, spec.visual.global_.offheight = 800, 600
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="ball")
        for p in LIGHTS:
            spec.worldbody.add_light(pos=p, dir=[-c for c in p], castshadow=True)
        self.of, self.model = mujoco, spec.compile()
        self.data, self.renderer, self.size = mujoco.MjData(self.model), None, None
        mujoco.mj_forward(self.model, self.data)

    def frames(self, size, first, count):
        if self.size != size:
            if self.renderer:
                self.renderer.close()
            self.renderer, self.size = self.of.Renderer(self.model, size[1], size[0]), size
        camera = self.of.MjvCamera()
        camera.distance, camera.lookat[:] = 3.35, 0
        for k in range(count):
            camera.azimuth, camera.elevation = 2.9 * (first + k), -17
            self.renderer.update_scene(self.data, camera)
            self.renderer.render()


class Open3d:
    """Filament on llvmpipe; two lights, its shadow maps."""

    def __init__(self, mesh, threads):
        os.environ["EGL_PLATFORM"] = "surfaceless"
        os.environ["LP_NUM_THREADS"] = str(threads)
        import open3d

        self.of, self.renderers = open3d, {}  # none is ever closed: it ends the process
        self.mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(mesh[0]), open3d.utility.Vector3iVector(mesh[1].astype(numpy.int32)))
        self.mesh.vertex_normals = open3d.utility.Vector3dVector(mesh[2])

    def frames(self, size, first, count):
        rendering = self.of.visualization.rendering
        if size not in self.renderers:
            self.renderer = self.renderers[size] = rendering.OffscreenRenderer(*size)
            material = rendering.MaterialRecord()
            material.shader = "defaultLit"
            self.renderer.scene.add_geometry("ball", self.mesh, material)
            for i, p in enumerate(LIGHTS):
                self.renderer.scene.scene.add_spot_light(str(i), (1, 1, 1), p, [-c for c in p], 1e5, 50, 0.5, 0.6, True)
        for k in range(count):
            self.renderer.setup_camera(FOV, (0, 0, 0), pose(first + k)[:3, 3], (0, 1, 0))
            numpy.asarray(self.renderer.render_to_image())


class Cycles:
    """One sample, CPU."""

    def __init__(self, mesh, threads):
        import bpy

        self.of = bpy
        bpy.ops.wm.read_factory_settings(use_empty=True)
        data = bpy.data.meshes.new("ball")
        data.from_pydata(mesh[0].tolist(), [], mesh[1].tolist())
        bpy.context.collection.objects.link(bpy.data.objects.new("ball", data))
        for p in LIGHTS:
            light = bpy.data.objects.new("light", bpy.data.lights.new("light", "POINT"))
            light.data.energy, light.location = 1000, p
            bpy.context.collection.objects.link(light)
        camera = bpy.data.cameras.new("camera")
        camera.sensor_fit, camera.angle = "VERTICAL", numpy.radians(FOV)
        self.camera = bpy.data.objects.new("camera", camera)
        bpy.context.collection.objects.link(self.camera)
        scene = self.scene = bpy.context.scene
        scene.camera, scene.render.engine, scene.cycles.samples = self.camera, "CYCLES", 1
        scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = False, False
        scene.cycles.max_bounces, scene.render.use_persistent_data = 1, True
        scene.render.threads_mode, scene.render.threads = "FIXED", threads

    def frames(self, size, first, count):
        import mathutils

        self.scene.render.resolution_x, self.scene.render.resolution_y = size
        for k in range(count):
            self.camera.matrix_world = mathutils.Matrix(pose(first + k).tolist())
            self.of.ops.render.render()


class Mitsuba:
    """llvm: direct light, one sample, of one light chosen at random."""

    def __init__(self, mesh, threads):
        import mitsuba

        mitsuba.set_variant("llvm_ad_rgb")
        import drjit

        drjit.set_thread_count(threads)
        shape = mitsuba.Mesh("ball", len(mesh[0]), len(mesh[1]), has_vertex_normals=True)
        parameters = mitsuba.traverse(shape)
        parameters["vertex_positions"], parameters["faces"] = mesh[0].ravel(), mesh[1].ravel()
        parameters["vertex_normals"] = mesh[2].ravel()
        parameters.update()
        world = {"type": "scene", "integrator": {"type": "direct", "bsdf_samples": 0, "emitter_samples": 1}, "ball": shape}
        for i, p in enumerate(LIGHTS):
            world[f"light{i}"] = {"type": "point", "position": p, "intensity": 30.0}
        self.of, self.scene, self.sensors = mitsuba, mitsuba.load_dict(world), {}

    def frames(self, size, first, count):
        if size not in self.sensors:
            sensor = self.of.load_dict({"type": "perspective", "fov": FOV, "fov_axis": "y", "sampler": {"type": "independent"},
                                        "film": {"type": "hdrfilm", "width": size[0], "height": size[1], "rfilter": {"type": "box"}}})
            self.sensors[size] = sensor, self.of.traverse(sensor)
        sensor, parameters = self.sensors[size]
        for k in range(count):
            flip = numpy.diag([-1.0, 1, -1, 1])  # it looks along +z, x to the left
            parameters["to_world"] = self.of.Transform4f(pose(first + k) @ flip)
            parameters.update()
            numpy.array(self.of.render(self.scene, sensor=sensor, spp=1))


PEERS = {"pinocchio": Pinocchio, "pinocchio, a call a frame": PinocchioOne, "pyrender": Pyrender,
         "pyrender, shadows": PyrenderShadows, "MuJoCo": Mujoco, "Open3D": Open3d, "Cycles": Cycles, "Mitsuba": Mitsuba}


def measure(name, triangles, seconds, threads):
    """{size: milliseconds a frame}, of warm frames, the median of three rounds."""
    peer, found = PEERS[name](ball(triangles), threads), {}
    for size in SIZES:
        peer.frames(size, 0, 2)
        begin = time.perf_counter()
        peer.frames(size, 2, 2)
        count = max(2, min(400, int(seconds / 3 / max(1e-6, (time.perf_counter() - begin) / 2))))
        rounds = []
        for r in range(3):
            begin = time.perf_counter()
            peer.frames(size, 5 + r, count)
            rounds.append(1e3 * (time.perf_counter() - begin) / count)
        found["%dx%d" % size] = sorted(rounds)[1]
    return found


def table(results):
    keys = [(t, s) for t in TRIANGLES for s in ("%dx%d" % size for size in SIZES)]
    print("| frames/s | " + " | ".join(f"{t // 1000}k {s}" for t, s in keys) + " |")
    print("|---" * (len(keys) + 1) + "|")
    for name in PEERS:
        cells = []
        for t, s in keys:
            ms = results.get(f"{name}/{t}", {}).get(s)
            cells.append(f"{1e3 / ms:.3g}" if ms else "-")
        print(f"| {name} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results")
    parser.add_argument("--only", nargs="*", default=list(PEERS), choices=list(PEERS))
    parser.add_argument("--triangles", nargs="*", type=int, default=TRIANGLES)
    parser.add_argument("--seconds", type=float, default=1.5, help="of drawing, for each size")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--child", action="store_true", help=argparse.SUPPRESS)
    o = parser.parse_args()
    if o.child:
        print(json.dumps(measure(o.only[0], o.triangles[0], o.seconds, o.threads)), flush=True)
        os._exit(0)
    results = json.load(open(o.results)) if os.path.exists(o.results) else {}
    for name in [] if o.table else o.only:
        for triangles in o.triangles:
            command = [sys.executable, __file__, o.results, "--child", "--only", name, "--triangles", str(triangles),
                       "--seconds", str(o.seconds), "--threads", str(o.threads)]
            child = subprocess.run(command, capture_output=True, text=True)
            try:
                results[f"{name}/{triangles}"] = json.loads(child.stdout.strip().splitlines()[-1])
            except (IndexError, ValueError):
                print(f"{name}, {triangles} triangles: {(child.stderr.strip() or 'nothing said').splitlines()[-1]}", file=sys.stderr)
            with open(o.results, "w") as file:
                json.dump(results, file, indent=1)
    table(results)


if __name__ == "__main__":
    main()
