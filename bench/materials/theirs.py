"""Mitsuba 3's pictures (variant llvm_ad_rgb): direct light under a sky, seen from the same place."""
import glob
import os
import time


OLDEST_LLVM = 17  # 16 and older fail on AVX-512


def newest_llvm():
    """The library's path; None where all are too old."""
    found = glob.glob("/usr/lib/*/libLLVM-*.so.1") + glob.glob("/usr/lib/*/libLLVM.so.*")
    version = lambda path: int("".join(c if c.isdigit() else " " for c in os.path.basename(path)).split()[0])
    return max((path for path in found if version(path) >= OLDEST_LLVM), key=version, default=None)


def start(threads):
    """Mitsuba, on that many threads."""
    library = newest_llvm()
    if library:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", library)
    import drjit
    import mitsuba

    mitsuba.set_variant("llvm_ad_rgb")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    drjit.set_thread_count(threads)
    return mitsuba


def rgb(value):
    return {"type": "rgb", "value": list(value)}


def principled(base, metallic, roughness):
    """The nearest of Mitsuba's materials, of numbers or textures: f0 of 0.04 is its `specular` of 0.5. Its matt part is Disney's, which sends light back."""
    return {"type": "principled", "base_color": base, "metallic": metallic, "roughness": roughness, "specular": 0.5}


class Scene:
    """Shapes under a sky, which is an array: with one thread, Mitsuba waits forever for an EXR file. Pictures are (height, width, 4); the sky itself is not drawn, the last channel is what the shapes cover."""

    def __init__(self, mitsuba, shapes, sky, view, size, integrator=None):
        eye, target, fov = view
        self.mitsuba = mitsuba
        self.scene = mitsuba.load_dict({
            "type": "scene", "integrator": integrator or {"type": "path", "max_depth": 2, "hide_emitters": True},
            "sky": {"type": "envmap", "bitmap": mitsuba.Bitmap(sky)}, **shapes})
        self.sensor = mitsuba.load_dict({
            "type": "perspective", "fov_axis": "y", "fov": fov, "near_clip": 1e-3, "far_clip": 1e5,
            "to_world": mitsuba.ScalarTransform4f().look_at(origin=list(eye), target=list(target), up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": size[0], "height": size[1], "rfilter": {"type": "box"}, "pixel_format": "rgba",
                     "component_format": "float32"},
            "sampler": {"type": "independent", "sample_count": 1}})

    def render(self, samples, seed=0):
        """The picture and its milliseconds; the first of each number of samples compiles, so it is drawn twice."""
        import numpy

        begin = time.perf_counter()
        picture = numpy.array(self.mitsuba.render(self.scene, sensor=self.sensor, spp=samples, seed=seed))
        return picture, 1e3 * (time.perf_counter() - begin)

    def mean_of(self, samples, seed=0, at_once=64):
        """A picture of many samples, as a mean of pictures of at most `at_once`."""
        parts = max(1, samples // at_once)
        step = min(samples, at_once)
        return sum(self.render(step, seed + i)[0].astype(float) for i in range(parts)) / parts

    def parameters(self):
        return self.mitsuba.traverse(self.scene)
