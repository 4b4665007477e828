"""Threads that do not start, and memory that runs out: one clear error or warning, and the next picture is right."""
import subprocess
import sys

DRAW = """
import pathlib, resource, warnings
import pinocchio_renderer as pinocchio
scene = pinocchio.load_scene({scene!r})
soft, hard = resource.getrlimit(resource.RLIMIT_AS)
def limit(more_mib):
    pages = int(pathlib.Path('/proc/self/statm').read_text().split()[0])
    most = soft if more_mib is None else pages * resource.getpagesize() + more_mib * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (most, hard))
def picture(engine):
    return engine.render(scene, size=(48, 32), mode='raytrace').color.tobytes()
"""


def run(scenes, code):
    code = DRAW.format(scene=str(scenes / "cornell.gltf")) + code
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=240)
    assert ran.returncode == 0, ran.stderr


# Each thread has a stack of 8 MiB: 1024 of them are more than there is.
def test_threads_that_do_not_start_are_one_warning(scenes):
    run(scenes, """
right = picture(pinocchio.Engine(threads=2))
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter('always')
    limit(1000)
    engine = pinocchio.Engine(threads=1024)
    same = picture(engine) == right
    limit(None)
assert same
assert len(said) == 1 and 'threads could be started' in str(said[0].message), [str(w.message) for w in said]
""")


def test_memory_that_runs_out_is_an_error_and_the_next_picture_is_right(scenes):
    run(scenes, """
import numpy
engine, tracer = pinocchio.Engine(threads=2), pinocchio.Tracer(numpy.eye(3), numpy.array([[0, 1, 2]]), threads=1)
right, rays = picture(engine), numpy.ones((4_000_000, 3), numpy.float32)
def fails(call, more_mib):
    limit(more_mib)
    try:
        call()
    except MemoryError:
        return True
    finally:
        limit(None)
assert fails(lambda: tracer.closest_hits(rays, rays), 8)
assert numpy.isfinite(tracer.closest_hits(rays[:3], -rays[:3])[0]).all()
for more_mib in (8, 64, 256):
    assert fails(lambda: engine.render(scene, size=(8000, 6000), mode='raytrace'), more_mib)
    assert fails(lambda: engine.render_many(scene, [None] * 400, (1000, 800), mode='raytrace'), more_mib)
    assert picture(engine) == right
""")
