"""Scenes, cameras, lights and materials in other processes, and copies of them."""
import copy
import io
import multiprocessing
import pickle

import numpy
import pinocchio_renderer as pn
import pytest

from test_tracer import quad


def again(value):
    return pickle.loads(pickle.dumps(value))


def drawn(scene, camera=None):
    return pn.Engine(threads=1).render(scene, camera, size=(48, 36)).color


@pytest.mark.parametrize("name", ["cornell.gltf", "two-lights.gltf", "windmill.glb", "terrace.glb", "speedboat.glb"])
def test_a_scene_that_pickles_is_the_same(scenes, name):
    if not (scenes / name).exists():
        pytest.skip(f"there is no {name}")
    scene = pn.load_scene(scenes / name)
    read = again(scene)
    numpy.testing.assert_array_equal(drawn(read), drawn(scene))
    assert read.nodes == scene.nodes and read.source == scene.source and len(read.cameras) == len(scene.cameras)
    numpy.testing.assert_array_equal(read.triangle_nodes, scene.triangle_nodes)
    if scene.duration:
        numpy.testing.assert_array_equal(drawn(read.at_time(0.7)), drawn(scene.at_time(0.7)))
    assert pickle.dumps(read) == pickle.dumps(scene)


def test_what_a_scene_holds_pickles_with_it():
    light = pn.Light(position=(1, 2, 3), direction=(0, 0, -1), color=(1, 0.5, 0), radius=0.25, name="lamp")
    texels = numpy.arange(48, dtype=numpy.uint8).reshape(4, 4, 3)
    material = pn.Material(diffuse=(0.1, 0.2, 0.3), texture=texels, name="paint", double_sided=False)
    sky = numpy.random.default_rng(1).uniform(0, 1, (8, 16, 3)).astype(numpy.float32)
    uvs = numpy.array([[0, 1], [1, 1], [1, 0], [0, 0]], numpy.float32)
    scene = pn.Scene(*quad(), uvs=uvs, materials=material, lights=[light], environment=sky)
    scene.cameras = [pn.Camera((0, 0, 4), (0, 0, 0), name="front")]
    for other in (again(scene), copy.deepcopy(scene), copy.copy(scene)):
        numpy.testing.assert_array_equal(drawn(other), drawn(scene))
        numpy.testing.assert_array_equal(other.environment, sky)
        numpy.testing.assert_array_equal(other.uvs, uvs)
        assert repr(other) == repr(scene) and repr(other.lights) == repr(scene.lights)
        assert other.cameras[0].name == "front"
    paint = again(material)
    numpy.testing.assert_array_equal(paint.texture[..., :3], texels)
    assert paint.diffuse == material.diffuse and paint.double_sided is False
    lamp, front = again(light), again(scene.cameras[0])
    assert (lamp.name, lamp.kind, lamp.radius, lamp.color) == ("lamp", "spot", 0.25, (1, 0.5, 0))
    assert (front.eye, front.target, front.fov) == ((0, 0, 4), (0, 0, 0), 45)


def test_a_deep_copy_has_lights_of_its_own():
    scene = pn.Scene(*quad(), lights=[pn.Light(position=(0, 0, 3))])
    other = copy.deepcopy(scene)
    other.lights[0].intensity = 0
    other.lights.append(pn.Light(direction=(0, 0, -1)))
    assert len(scene.lights) == 1 and scene.lights[0].intensity == 1
    assert numpy.shares_memory(other.vertices, scene.vertices)


def test_settings_are_a_dict_that_pickles():
    settings = dict(spp=2, bounces=1, seed=7)
    scene = pn.Scene(*quad())
    numpy.testing.assert_array_equal(pn.Engine().render(scene, size=(8, 8), **again(settings)).color,
                                     pn.Engine().render(scene, size=(8, 8), **settings).color)


def test_a_damaged_pickle_is_an_error():
    state = pn.Camera((0, 0, 4), (0, 0, 0)).__getstate__()
    empty = pn.Camera.__new__(pn.Camera)
    for wrong in (b"", state[:-3], b"x" * 200, state.replace(b"pinocchio_renderer", b"pinocchio_rendere2")):
        with pytest.raises(pn.Error, match="the pickle is"):
            empty.__setstate__(wrong)
    big = pn.Scene(*quad()).__getstate__()
    for cut in range(0, len(big), 7):
        with pytest.raises(pn.Error):
            pn.Scene.__new__(pn.Scene).__setstate__(big[:cut])


@pytest.mark.parametrize("make, says", [
    (lambda: pn.Engine(threads=1), "create one in each process"),
    (lambda: pn.Tracer(*quad()), "create one in each process"),
    (lambda: pn.Engine(threads=1).render(pn.Scene(*quad()), size=(4, 4)), "send its arrays"),
])
def test_what_does_not_pickle_says_what_to_do(make, says):
    with pytest.raises(TypeError, match=says):
        pickle.dump(make(), io.BytesIO())


def draw_in_worker(job):
    scene, camera, settings = job
    return pn.Engine(threads=1).render(scene, camera, size=(48, 36), **settings).color


def test_spawned_workers_get_scenes(scenes):
    scene = pn.load_scene(scenes / "cornell.gltf")
    cameras = [scene.camera(), pn.Camera((0, 1, 4), (0, 1, 0))]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        pictures = pool.map(draw_in_worker, [(scene, camera, {"spp": 1}) for camera in cameras])
    for picture, camera in zip(pictures, cameras):
        numpy.testing.assert_array_equal(picture, drawn(scene, camera))
