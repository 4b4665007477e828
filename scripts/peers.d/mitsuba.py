# needs: mitsuba numpy
"""Mitsuba 3, variant llvm_ad_rgb: direct light, a sample a pixel, a sample a light."""
import glob
import os


def find_llvm():
    """The newest LLVM of the system (Debian 12: libllvm19): 16 and older fail on AVX-512."""
    if "DRJIT_LIBLLVM_PATH" not in os.environ:
        found = glob.glob("/usr/lib/*/libLLVM-*.so.1") + glob.glob("/usr/lib/*/libLLVM.so.*")
        version = lambda path: int("".join(c if c.isdigit() else " " for c in os.path.basename(path)).split()[0])
        if found:
            os.environ["DRJIT_LIBLLVM_PATH"] = max(found, key=version)


def frames(job):
    """Yields after each frame."""
    find_llvm()
    import drjit as dr
    import mitsuba as mi
    mi.set_variant("llvm_ad_rgb")
    dr.set_thread_count(job["threads"])
    T = mi.ScalarTransform4f
    scene = {
        "type": "scene",
        "integrator": {"type": "direct", "emitter_samples": len(job["lights"]), "bsdf_samples": 0},
        "sensor": {
            "type": "perspective", "fov_axis": "y", "fov": job["fov"],
            "to_world": T().look_at(origin=job["eye"], target=job["target"], up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": job["size"][0], "height": job["size"][1],
                     "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": 1}},
        "mesh": {"type": os.path.splitext(job["mesh"])[1][1:], "filename": job["mesh"],
                 "bsdf": {"type": "twosided", "nested": {"type": "diffuse"}}}}
    for i, light in enumerate(job["lights"]):
        scene[f"light{i}"] = {"type": "point", "position": light, "intensity": {"type": "rgb", "value": 10.0}}
    scene = mi.load_dict(scene)
    seed = 0
    while True:
        picture = mi.render(scene, spp=1, seed=seed)
        dr.eval(picture)
        dr.sync_thread()
        seed += 1
        yield
