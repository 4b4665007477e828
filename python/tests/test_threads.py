"""Several Python threads at one object, while the GIL is released."""
import ctypes
import subprocess
import sys
import threading

import numpy
import pinocchio_renderer as pn
import pytest


def at_the_same_time(count, call):
    """What each of `count` threads got from call(i), all begun together."""
    barrier, got = threading.Barrier(count), [None] * count

    def run(i):
        barrier.wait()
        try:
            got[i] = call(i)
        except BaseException as error:  # noqa: BLE001
            got[i] = error

    threads = [threading.Thread(target=run, args=(i,)) for i in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return got


def test_arrays_that_are_asked_for_at_the_same_time_are_the_same(scenes):
    engine, scene = pn.Engine(threads=1), pn.load_scene(scenes / "cornell.gltf")
    for _ in range(5):
        result = engine.render(scene, size=(160, 120))
        arrays = at_the_same_time(6, lambda i: result.depth)
        assert len({array.__array_interface__["data"][0] for array in arrays}) == 1
        numpy.testing.assert_array_equal(arrays[0], engine.render(scene, size=(160, 120)).depth)


def test_an_exr_is_written_while_reflections_are_first_asked_for(scenes, tmp_path):
    engine, scene = pn.Engine(threads=1), pn.load_scene(scenes / "cornell.gltf")
    result = engine.render(scene, size=(320, 240), bounces=0, glass_shadows="opaque")
    got = at_the_same_time(2, lambda i: result.reflection if i else result.write_exr(tmp_path / "x.exr"))
    assert got[0] is None and not got[1].any()
    assert numpy.array_equal(result.reflection, got[1])


# A process of its own: where a scene is read while it changes, it dies.
def test_a_scene_may_change_while_it_is_read(scenes):
    code = f"""
import threading, pinocchio_renderer as pn
scene = pn.load_scene({str(scenes / 'windmill.glb')!r})
name, done = scene.nodes[0], threading.Event()
lights = [[pn.Light((0, 9, 0), name='x' * 50, casts_shadow=False)] * n for n in (1, 40, 3, 200)]
def change():
    i = 0
    while not done.is_set():
        i += 1
        scene.lights = lights[i % 4]
        scene.cameras = [pn.Camera((0, 0, 9), (0, 0, 0), name='y' * 50)] * (i % 7)
thread = threading.Thread(target=change, daemon=True)
thread.start()
eye = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
engine = pn.Engine(threads=1)
for i in range(300):
    moved = scene.at_time(i / 100), scene.posed({{name: eye}})
    assert all(len(s.lights) in (1, 3, 40, 200) and len(s.cameras) < 7 for s in moved)
    if i % 30 == 0:
        engine.render(scene, pn.Camera((0, 2, 9), (0, 0, 0)), size=(8, 8), mode='raytrace')
done.set()
thread.join()
"""
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert ran.returncode == 0, ran.stderr


class DLTensor(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("device_type", ctypes.c_int32), ("device_id", ctypes.c_int32),
                ("ndim", ctypes.c_int32), ("code", ctypes.c_uint8), ("bits", ctypes.c_uint8), ("lanes", ctypes.c_uint16),
                ("shape", ctypes.POINTER(ctypes.c_int64)), ("strides", ctypes.POINTER(ctypes.c_int64)),
                ("byte_offset", ctypes.c_uint64)]


class DLManagedTensor(ctypes.Structure):
    _fields_ = [("tensor", DLTensor), ("context", ctypes.c_void_p), ("deleter", ctypes.c_void_p)]


class Tensor:
    """float32 in memory that DLPack says is on `device` (2: CUDA)."""

    def __init__(self, shape, device):
        self.device, self.array = device, numpy.zeros(shape, numpy.float32)
        self.shape = (ctypes.c_int64 * len(shape))(*shape)
        self.managed = DLManagedTensor(DLTensor(self.array.ctypes.data, device, 0, len(shape), 2, 32, 1, self.shape, None, 0))

    def __dlpack_device__(self):
        return self.device, 0

    def __dlpack__(self, **_):
        new = ctypes.pythonapi.PyCapsule_New
        new.restype, new.argtypes = ctypes.py_object, [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
        return new(ctypes.addressof(self.managed), b"dltensor", None)


class OnlyCuda:
    __cuda_array_interface__ = {"shape": (1, 6, 8, 4), "typestr": "<f4", "data": (4096, False), "version": 3}


def test_pictures_are_written_to_the_cpus_memory_alone(scenes):
    engine, scene = pn.Engine(threads=1), pn.load_scene(scenes / "cornell.gltf")

    def draw(out):
        return engine.render_many(scene, [None], (8, 6), out={"color": out})["color"]

    for device in (2, 10):
        tensor = Tensor((1, 6, 8, 4), device)
        with pytest.raises(TypeError, match=f"out\\['color'\\] is on another device .DLPack's type {device}."):
            draw(tensor)
        assert not tensor.array.any()
    locked = numpy.zeros((1, 6, 8, 4), numpy.float32)
    locked.flags.writeable = False
    for wrong in (OnlyCuda(), [0.0], "color", None, locked):
        with pytest.raises(TypeError, match="out\\['color'\\] is no array that can be written to"):
            draw(wrong)
    assert not locked.any()
    with pytest.raises(pn.Error, match="not of the shape"):
        draw(Tensor((1, 6, 8, 3), 1))
    tensor = Tensor((1, 6, 8, 4), 1)
    assert draw(tensor) is tensor
    numpy.testing.assert_array_equal(tensor.array[0], engine.render(scene, size=(8, 6)).color)
