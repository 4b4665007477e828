"""Frames of a scene by Mitsuba 3 (variant llvm_ad_rgb), timed, and how far one is from what it converges to.

    mitsuba_frames.py JOB.json     prints {"SAMPLES": {"ms": [...], "picture": "FILE.exr"}, ..., "truth": "FILE.exr"}

The job: "obj" (as pinocchio-embree-frame exports a scene, with its .mtl), "lights", "cameras", "size", "threads", "depth",
"samples" (a list), "truth" (samples of its converged picture), "frames" (timed, at most), "folder". Path tracing, which also brings light from
wall to wall, as deep as our mirrors; with depth 0 direct light alone. Its materials are the nearest that it has: Phong's highlights are left out, colour maps are read, and lights that are as
strong everywhere fall off by the square, as bright as ours in the scene's middle. So it is held against its own picture, not ours.
"""
import glob
import json
import math
import os
import pathlib
import sys
import time

WARM_UP = 3  # frames
PATIENCE_MS = 5000  # with as many samples; three frames at least


def find_llvm():
    """The newest of the system: 16 and older fail on AVX-512."""
    found = glob.glob("/usr/lib/*/libLLVM-*.so.1") + glob.glob("/usr/lib/*/libLLVM.so.*")
    version = lambda path: int("".join(c if c.isdigit() else " " for c in os.path.basename(path)).split()[0])
    if found:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", max(found, key=version))


def read_mtl(path):
    materials = {}
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["newmtl"]:
            material = materials[words[1]] = {}
        elif words and not words[0].startswith("#"):
            material[words[0]] = words[1:]
    return materials


def numbers(material, key, otherwise):
    return [float(w) for w in material.get(key, otherwise)]


def rgb(value):
    return {"type": "rgb", "value": value}


def bsdf_of(material, folder):
    kind = material.get("illum", ["2"])[0]
    if kind == "7":
        return {"type": "dielectric", "int_ior": numbers(material, "Ni", [1.0])[0], "ext_ior": 1.0,
                "specular_transmittance": rgb(numbers(material, "Tf", [1, 1, 1]))}
    diffuse = {"type": "diffuse", "reflectance": rgb([min(c, 0.98) for c in numbers(material, "Kd", [0.8] * 3)])}
    if "map_Kd" in material:
        diffuse["reflectance"] = {"type": "bitmap", "filename": str(folder / material["map_Kd"][-1])}
    if kind in ("3", "5"):  # ours adds the mirror to the matt part; a blend takes from one what it gives the other
        mirrored = numbers(material, "Ks", [0] * 3)
        weight = min(max(max(mirrored), 1e-3), 1.0)
        mirror = {"type": "conductor", "material": "none", "specular_reflectance": rgb([min(c / weight, 1.0) for c in mirrored])}
        if "map_Kd" not in material and weight < 1:
            diffuse["reflectance"] = rgb([min(c / (1 - weight), 0.98) for c in diffuse["reflectance"]["value"]])
        diffuse = {"type": "blendbsdf", "weight": weight, "matt": diffuse, "mirror": mirror}
    surface = {"type": "twosided", "nested": diffuse}
    if "map_d" in material:
        channel = "a" if "-imfchan" not in material["map_d"] else material["map_d"][material["map_d"].index("-imfchan") + 1]
        if channel != "m":
            return surface
        surface = {"type": "mask", "opacity": {"type": "bitmap", "filename": str(folder / material["map_d"][-1]), "raw": True}, "nested": surface}
    return surface


def shapes_of(obj, folder):
    """A shape for each material, with the vertices that it uses."""
    head, parts, current = [], {}, None
    for line in obj.read_text().splitlines(True):
        if line.startswith("usemtl"):
            current = parts.setdefault(line.split()[1], [])
        elif line.startswith("f "):
            current.append(line)
        elif line.startswith("v"):
            head.append(line if not line.startswith("v ") else " ".join(line.split()[:4]) + "\n")
    materials = read_mtl(obj.with_suffix(".mtl"))
    shapes = {}
    for i, (name, faces) in enumerate(parts.items()):
        path = folder / f"part-{i}.obj"
        path.write_text("".join(head) + "".join(faces))
        flat = all(len(corner.split("/")) < 3 for corner in faces[0].split()[1:])
        shapes[f"shape{i}"] = {"type": "obj", "filename": str(path), "face_normals": flat,
                               "bsdf": bsdf_of(materials[name], obj.parent)}
        glow = numbers(materials[name], "Ke", [0] * 3)
        if max(glow) > 0:
            shapes[f"shape{i}"]["emitter"] = {"type": "area", "radiance": rgb(glow)}
    return shapes


def emitters_of(job, mitsuba, middle):
    """Where coefficients are albedos, as Phong's, and no BRDF's values, the 1 / pi is counted to the light."""
    found = {}
    factor = math.pi if job["lights"]["count_pi"] else 1.0
    for i, light in enumerate(job["lights"]["all"]):
        strength = [factor * c for c in light["radiance"]]
        if light["directional"]:
            found[f"light{i}"] = {"type": "directional", "direction": light["direction"], "irradiance": rgb(strength)}
            continue
        square = 1.0 if light["inverse_square"] else math.dist(light["position"], middle) ** 2
        found[f"light{i}"] = {"type": "point", "position": light["position"], "intensity": rgb([square * c for c in strength])}
    return found


def main():
    job = json.loads(pathlib.Path(sys.argv[1]).read_text())
    folder = pathlib.Path(job["folder"])
    folder.mkdir(parents=True, exist_ok=True)
    find_llvm()
    import drjit
    import mitsuba
    import numpy

    mitsuba.set_variant("llvm_ad_rgb")
    drjit.set_thread_count(job["threads"])
    shapes = shapes_of(pathlib.Path(job["obj"]), folder)
    lamps = emitters_of(job, mitsuba, job["cameras"][0]["target"])
    scene = mitsuba.load_dict({"type": "scene", "integrator": {"type": "path", "max_depth": 2 if job["depth"] == 0 else job["depth"] + 2},
                               **shapes, **lamps})

    def sensor(camera):
        return mitsuba.load_dict({
            "type": "perspective", "fov_axis": "y", "fov": camera["fov"],
            "to_world": mitsuba.ScalarTransform4f().look_at(camera["eye"], camera["target"], camera["up"]),
            "film": {"type": "hdrfilm", "width": job["size"][0], "height": job["size"][1], "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": 1}})

    sensors = [sensor(camera) for camera in job["cameras"]]
    last, results = len(sensors) - 1, {}

    def render(k, samples, seed):
        return mitsuba.render(scene, sensor=sensors[k], spp=samples, seed=seed)

    for samples in job["samples"]:
        times = []
        warm_up = 1 if results else WARM_UP
        while len(times) < warm_up + 3 or (len(times) < warm_up + job["frames"] and sum(times) < PATIENCE_MS):
            begin = time.perf_counter()
            numpy.array(render(len(times) % len(sensors), samples, len(times)))
            times.append(1e3 * (time.perf_counter() - begin))
        picture = folder / f"mitsuba-{samples}.exr"
        mitsuba.Bitmap(render(last, samples, 1)).write(str(picture))
        results[str(samples)] = {"ms": times[warm_up:], "picture": str(picture)}
    step, parts = 32, max(1, job["truth"] // 32)
    mean = sum(numpy.array(render(last, step, 1000 + i)) for i in range(parts)) / parts
    results["truth"] = str(folder / "mitsuba-truth.exr")
    mitsuba.Bitmap(mean.astype(numpy.float32)).write(results["truth"])
    print(json.dumps(results), flush=True)
    os._exit(0)  # it may not survive its end


if __name__ == "__main__":
    main()
