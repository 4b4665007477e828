"""The grid of spheres: ours beside Mitsuba's principled model, and beside glTF's own reflection model."""
import numpy

import appendix_b
import cases
import figures
import measure
import skies
import theirs

VIEW = (cases.EYE, cases.TARGET, cases.FOV)
REFERENCE_SAMPLES = 256


class Ball:
    """A sphere of Mitsuba's whose material may be changed without compiling anew."""

    def __init__(self, mitsuba, sky, size):
        self.mitsuba = mitsuba
        self.scene = theirs.Scene(mitsuba, {"ball": {"type": "sphere", "bsdf": theirs.principled(theirs.rgb([0.5] * 3), 0.5, 0.5)}}, sky, VIEW, size)
        self.gltf = mitsuba.load_dict({"type": "gltf", "base_color": theirs.rgb([0.5] * 3), "metallic": 0.5, "roughness": 0.5})
        self.reference = theirs.Scene(mitsuba, {"ball": {"type": "sphere", "bsdf": self.gltf}}, sky, VIEW, size)

    def become(self, case):
        import drjit

        parameters = self.scene.parameters()
        parameters["ball.bsdf.base_color.value"] = self.mitsuba.Color3f(*case.base)
        parameters["ball.bsdf.metallic.value"] = case.metallic
        parameters["ball.bsdf.roughness.value"] = case.roughness
        parameters.update()
        self.gltf.base, self.gltf.metallic = self.mitsuba.Color3f(*case.base), self.mitsuba.Float(case.metallic)
        self.gltf.roughness = self.mitsuba.Float(case.roughness)
        drjit.make_opaque(self.gltf.base, self.gltf.metallic, self.gltf.roughness)


def furnace(picture, mask, mu):
    """Mean, centre and the brightest ring of a sphere under the even sky."""
    height, width = mask.shape
    middle = figures.grey(picture)[height // 2 - 5:height // 2 + 5, width // 2 - 5:width // 2 + 5]
    return {"mean": float(figures.grey(picture)[mask].mean()), "centre": float(middle.mean()), "brightest_ring": max(figures.rings(picture, mask, mu))}


def run(mitsuba, ours, files, folder, quick, tell):
    """Yields a row for each sphere and sky."""
    mu = numpy.nan_to_num(appendix_b.cosines_of_pixels(ours.size, cases.EYE[2], cases.FOV, 1))
    for sky, file in files.items():
        ball = Ball(mitsuba, skies.ALL[sky](), ours.size)
        for case in cases.all_cases(quick, colours=sky == "even"):
            scene = cases.write_sphere(folder / "sphere.glb", case)
            ball.become(case)
            found, mask, pictures = measure.compare(lambda n, seed: ours.render(scene, VIEW, file, n, seed), ball.scene.render)
            row = {"sky": sky, "kind": case.kind, "name": case.name, "base": case.base, "metallic": case.metallic, "roughness": case.roughness, **found}
            if sky == "even":
                row["appendix_b"] = {c: figures.mean(appendix_b.picture(case, ours.size, cases.EYE[2], cases.FOV, c), mask).tolist()
                                     for c in appendix_b.COUPLINGS}
                row["plugin"] = figures.mean(ball.reference.render(REFERENCE_SAMPLES // 4, 10)[0], mask).tolist()  # must be "mix"
                row["furnace"] = furnace(pictures["ours, many"], mask, mu)
            else:
                row["appendix_b"] = {"mix": figures.mean(ball.reference.mean_of(REFERENCE_SAMPLES, 10), mask).tolist()}
            numpy.savez_compressed(folder / f"sphere-{sky}-{case.name}.npz", **figures.halves(pictures, ("ours", "theirs")))
            tell(describe(row))
            yield row


def share(ours, theirs):
    """Mean of ours over theirs; both black is 1."""
    a, b = float(numpy.mean(ours)), float(numpy.mean(theirs))
    return 1.0 if max(a, b) < 1e-4 else a / max(b, 1e-9)


def worst_colour(ours, theirs):
    """The channel that is farthest off, of those that are not faint."""
    a, b = numpy.array(ours), numpy.array(theirs)
    seen = b > 0.02 * max(b.max(), 1e-9)
    return float(max(abs(a[seen] / b[seen] - 1))) if seen.any() and b.max() > 1e-4 else 0.0


def describe(row):
    a, b = row["ours"], row["theirs"]
    return (f"{row['name']}, {row['sky']}: mean / principled {share(a['mean'], b['mean']):.3f}, / appendix B "
            f"{share(a['mean'], row['appendix_b']['mix']):.3f}; noise {a['noise']:.3f} beside {b['noise']:.3f}, "
            f"in the same time {a['noise_in_their_time']:.3f}")
