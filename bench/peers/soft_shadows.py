"""Soft shadows beside Mitsuba 3's direct light: the same floor, plate, light and camera, by both.

    soft_shadows.py PINOCCHIO FOLDER [--spp 256] [--mode raytrace] [--truth 4096] [--table]

Half of a floor lies under a plate; the light above is a ball or a rectangle. Each is
drawn with and without the plate: their ratio is how much of the light is visible, row by row. Written to FOLDER:
the scenes and a table; --table prints Mitsuba's profiles for tests/hybrid/soft_shadow_test.cpp. Needs PyPI's `mitsuba`
and `numpy`; Mitsuba is independent of us: its sampling, its ray tracer, its light sources.
"""
import argparse
import base64
import json
import math
import pathlib
import subprocess

import mitsuba
import numpy

SIZE = (48, 32)
EYE, TARGET, FOV = (1.5, 0.9, 0.0), (-0.2, 0.0, 0.0), 40.0  # under the plate, down at the floor
ALBEDO = 0.5
INTENSITY = 10.0
FLOOR = [(-6, 0, -6), (-6, 0, 6), (6, 0, 6), (6, 0, -6)]
PLATE = [(-4, 1, -4), (-4, 1, 4), (0, 1, 4), (0, 1, -4)]
LIGHTS = {
    "ball": {"position": (0.3, 2.5, 0.2), "radius": 0.5},
    "large ball": {"position": (0.3, 2.5, 0.2), "radius": 1.2},
    "rectangle": {"position": (0.3, 2.5, 0.2), "sides": (0.8, 1.2)},
}


def scene_gltf(light, plate):
    """Positions, four to a square, and the light, that faces down."""
    corners = numpy.array(FLOOR + (PLATE if plate else []), numpy.float32)
    indices = numpy.array([[k, k + 1, k + 2, k, k + 2, k + 3] for k in range(0, len(corners), 4)], numpy.uint32).ravel()
    data = corners.tobytes() + indices.tobytes()
    extras = {"rectangle": light["sides"]} if "sides" in light else {"radius": light["radius"]}
    phong = {"kd": ALBEDO / math.pi, "ka": 0}
    down = (-math.sqrt(0.5), 0, 0, math.sqrt(0.5))  # from -z to -y
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "point", "intensity": INTENSITY, "extras": {"pinocchio": extras}}]}},
        "nodes": [{"mesh": 0}, {"translation": light["position"], "rotation": down,
                                "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "materials": [{"extras": {"pinocchio": {"phong": phong}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(corners), "type": "VEC3",
             "min": corners.min(0).tolist(), "max": corners.max(0).tolist()},
            {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": corners.nbytes},
                        {"buffer": 0, "byteOffset": corners.nbytes, "byteLength": indices.nbytes}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}


def ours(arguments, name, light, plate, seed=0):
    stem = arguments.folder / f"{name.replace(' ', '-')}{'' if plate else '-open'}"
    stem.with_suffix(".gltf").write_text(json.dumps(scene_gltf(light, plate)))
    view = ["--size", "%dx%d" % SIZE, "--eye", "%g,%g,%g" % EYE, "--target", "%g,%g,%g" % TARGET, "--fov", str(FOV)]
    subprocess.run([arguments.pinocchio, "render", str(stem.with_suffix(".gltf")), *view, "--mode", arguments.mode,
                    "--spp", str(arguments.spp), "--seed", str(seed), *arguments.option, "--quiet", "--aov", "none", "-o", str(stem.with_suffix(".exr"))],
                   check=True)
    bitmap = mitsuba.Bitmap(str(stem.with_suffix(".exr")))
    return numpy.array(bitmap.convert(mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, False))[..., 0]


def square(corners):
    """Mitsuba's rectangle spans (-1, -1) to (1, 1) and shines along +z."""
    a, b, _, d = (numpy.array(c, float) for c in corners)
    u, v = (d - a) / 2, (b - a) / 2
    m = numpy.eye(4)
    m[:3] = numpy.column_stack([u, v, numpy.cross(v, u) / numpy.linalg.norm(numpy.cross(v, u)), a + u + v])
    return {"type": "rectangle", "to_world": mitsuba.ScalarTransform4f(m),
            "bsdf": {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": {"type": "spectrum", "value": ALBEDO}}}}


def theirs(arguments, light, plate, seed=0):
    if "sides" in light:
        u, v = light["sides"]
        radiance = INTENSITY / (u * v)
        shape = {"type": "rectangle", "to_world": mitsuba.ScalarTransform4f().translate(light["position"]) @
                 mitsuba.ScalarTransform4f().rotate((1, 0, 0), 90) @ mitsuba.ScalarTransform4f().scale((u / 2, v / 2, 1))}
    else:
        radiance = INTENSITY / (math.pi * light["radius"] ** 2)
        shape = {"type": "sphere", "center": light["position"], "radius": light["radius"]}
    shape["emitter"] = {"type": "area", "radiance": {"type": "spectrum", "value": radiance}}
    scene = {"type": "scene", "integrator": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0},
             "light": shape, "floor": square(FLOOR),
             "sensor": {"type": "perspective", "fov": FOV, "fov_axis": "y",
                        "to_world": mitsuba.ScalarTransform4f().look_at(EYE, TARGET, (0, 1, 0)),
                        "film": {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1], "rfilter": {"type": "box"},
                                 "pixel_format": "luminance", "component_format": "float32"},
                        "sampler": {"type": "multijitter", "sample_count": arguments.truth}}}
    if plate:
        scene["plate"] = square(PLATE)
    return numpy.array(mitsuba.render(mitsuba.load_dict(scene), seed=seed))[..., 0]


def compared(arguments, name, light):
    pictures = [draw(plate) for draw in (lambda p: ours(arguments, name, light, p),
                                               lambda p: theirs(arguments, light, p)) for plate in (True, False)]
    mine, mine_open, truth, truth_open = pictures
    mine_rows, truth_rows = ((a.sum(1) / b.sum(1)) for a, b in ((mine, mine_open), (truth, truth_open)))
    penumbra = (truth / truth_open > 0.02) & (truth / truth_open < 0.98)
    level = truth[penumbra].mean()

    def rms(difference):
        return float(numpy.sqrt((difference[penumbra] ** 2).mean()) / level)

    # Two pictures of independent samples differ by both their errors.
    mine_noise = rms(mine - ours(arguments, name, light, True, seed=1)) / math.sqrt(2)
    truth_noise = rms(truth - theirs(arguments, light, True, seed=1)) / math.sqrt(2)
    return {"our noise": mine_noise, "their noise": truth_noise,
            "what neither explains": math.sqrt(max(0.0, rms(mine - truth) ** 2 - mine_noise ** 2 - truth_noise ** 2)),
            "unshadowed": float(mine_open.sum() / truth_open.sum() - 1),
            "mean of the penumbra": float(mine[penumbra].sum() / truth[penumbra].sum() - 1),
            "pixels of the penumbra, rms": rms(mine - truth),
            "visibility by row, largest": float(abs(mine_rows - truth_rows).max()),
            "rows": truth_rows.tolist()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pinocchio")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--truth", type=int, default=4096)
    parser.add_argument("--mode", default="raytrace")
    parser.add_argument("--option", action="append", default=[], help="of ours, for instance --option=--sequence=random")
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    mitsuba.set_variant("scalar_rgb")
    print("| light | unshadowed | mean of the penumbra | visibility by row, largest | its pixels, rms | our noise | Mitsuba's | the rest |")
    print("|---|---|---|---|---|---|---|---|")
    for name, light in LIGHTS.items():
        found = compared(arguments, name, light)
        shown = [100 * found[k] for k in ("unshadowed", "mean of the penumbra", "pixels of the penumbra, rms", "our noise",
                                          "their noise", "what neither explains")]
        print("| %s | %.2f %% | %.2f %% | %.4f | %.2f %% | %.2f %% | %.2f %% | %.2f %% |" % (
            name, *shown[:2], found["visibility by row, largest"], *shown[2:]), flush=True)
        if arguments.table:
            print("{" + ", ".join("%.4ff" % v for v in found["rows"]) + "}")


if __name__ == "__main__":
    main()
