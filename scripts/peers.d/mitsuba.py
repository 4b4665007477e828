# needs: mitsuba numpy
"""Mitsuba 3, variant llvm_ad_rgb: direct light, a sample a pixel, a sample a light."""
import glob
import os

VARIANTS = {"Mitsuba": {}}


def find_llvm():
    """The newest LLVM of the system (Debian 12: libllvm19): 16 and older fail on AVX-512."""
    if "DRJIT_LIBLLVM_PATH" not in os.environ:
        found = glob.glob("/usr/lib/*/libLLVM-*.so.1") + glob.glob("/usr/lib/*/libLLVM.so.*")
        version = lambda path: int("".join(c if c.isdigit() else " " for c in os.path.basename(path)).split()[0])
        if found:
            os.environ["DRJIT_LIBLLVM_PATH"] = max(found, key=version)


def frames(job):
    find_llvm()
    import drjit
    import mitsuba
    import numpy

    mitsuba.set_variant("llvm_ad_rgb")
    drjit.set_thread_count(job.threads)
    scene = {
        "type": "scene",
        "integrator": {"type": "direct", "emitter_samples": len(job.lights), "bsdf_samples": 0},
        "mesh": {"type": "obj", "filename": job.mesh, "bsdf": {"type": "twosided", "nested": {"type": "diffuse"}}}}
    for i, light in enumerate(job.lights):
        scene[f"light{i}"] = {"type": "point", "position": light, "intensity": {"type": "rgb", "value": 10.0}}
    scene = mitsuba.load_dict(scene)
    sensor = mitsuba.load_dict({
        "type": "perspective", "fov_axis": "y", "fov": job.fov,
        "film": {"type": "hdrfilm", "width": job.size[0], "height": job.size[1], "rfilter": {"type": "box"}},
        "sampler": {"type": "independent", "sample_count": 1}})
    parameters = mitsuba.traverse(sensor)
    for k in range(10 ** 9):
        turned = job.pose(k) @ numpy.diag([-1.0, 1, -1, 1])  # it looks along +z, x to the left
        parameters["to_world"] = mitsuba.Transform4f(turned)
        parameters.update()
        numpy.array(mitsuba.render(scene, sensor=sensor, spp=1, seed=k))
        yield
