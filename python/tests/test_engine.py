"""Errors, threads, interrupts, many pictures at once."""
import os
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy
import pinocchio_renderer as pn
import pytest

ALL = ["color", "depth", "position", "normal", "albedo", "ids", "objects", "mask", "reflection"]


def test_many_pictures_are_the_pictures_one_by_one(scenes):
    scene = pn.load_scene(scenes / "two-lights.gltf")
    cameras = [scene.cameras[0] for _ in range(3)]
    for i, camera in enumerate(cameras):
        camera.eye = tuple(numpy.add(camera.eye, (0.1 * i, 0, 0)))
    engine = pn.Engine(threads=3)
    arrays = engine.render_many(scene, cameras, (70, 40), outputs=ALL)
    for i, camera in enumerate(cameras):
        one = engine.render(scene, camera, size=(70, 40))
        for name in ALL:
            numpy.testing.assert_array_equal(arrays[name][i], getattr(one, name), err_msg=name)
    again = engine.render_many(scene, cameras[::-1], (70, 40), outputs=ALL, out=arrays)
    for name in ALL:
        assert numpy.shares_memory(again[name], arrays[name])
    numpy.testing.assert_array_equal(again["ids"][2], engine.render(scene, cameras[0], size=(70, 40)).ids)


@pytest.mark.parametrize(
    "arguments, says",
    [
        ({"colour": 1}, "there is no setting 'colour'"),
        ({"bounces": 99}, "bounces is 99; it is a whole number from 0 to 64"),
        ({"mode": "best"}, "mode is best; it is one of"),
        ({"camera": "nowhere"}, "no camera 'nowhere'"),
        ({"size": (0, 5)}, "size is 0x5"),
        ({"mode": "raytrace", "visibility": "gpu", "composite": "cpu", "exchange": "reproject"}, "reproject"),
    ],
)
def test_errors_are_the_programs_line(scenes, arguments, says):
    scene = pn.load_scene(scenes / "cornell.gltf")
    with pytest.raises(pn.Error, match=says):
        pn.Engine().render(scene, **arguments)


def test_errors_of_opengl_are_the_programs_line(scenes, tmp_path, monkeypatch):
    scene = pn.load_scene(scenes / "cornell.gltf")
    monkeypatch.setenv("PINOCCHIO_SHADERS", str(tmp_path))  # where there are none
    with pytest.raises(pn.Error, match="fullscreen.vert|visibility.vert"):
        pn.Engine().render(scene, size=(16, 12), mode="hybrid")
    with pytest.raises(pn.Error, match="no OpenGL context"):
        pn.Engine(device="99").render(scene, size=(16, 12), mode="hybrid")


@pytest.mark.parametrize("first_ends_first", [True, False])
def test_engines_with_opengl_do_not_disturb_each_other(scenes, first_ends_first):
    scene = pn.load_scene(scenes / "cornell.gltf")

    def draw(engine, design, size):
        return engine.render(scene, size=size, mode="hybrid", design=design).color

    wanted = {"1": draw(pn.Engine(), "1", (64, 48)), "2": draw(pn.Engine(), "2", (80, 40))}
    engines = {"1": pn.Engine(), "2": pn.Engine()}
    sizes = {"1": (64, 48), "2": (80, 40)}
    for design in ["1", "2", "1", "2"]:
        numpy.testing.assert_array_equal(draw(engines[design], design, sizes[design]), wanted[design])
    del engines["1" if first_ends_first else "2"]
    (left,) = engines
    for design in ["1", "2"]:
        numpy.testing.assert_array_equal(draw(engines[left], design, sizes[design]), wanted[design])


def test_an_engine_with_opengl_serves_threads_in_turns(scenes):
    scene, engine, pictures = pn.load_scene(scenes / "cornell.gltf"), pn.Engine(), []

    def draw():
        pictures.append(engine.render(scene, size=(64, 48), mode="hybrid").color)

    for _ in range(3):
        thread = threading.Thread(target=draw)
        thread.start()
        thread.join()
    for picture in pictures:
        numpy.testing.assert_array_equal(picture, pictures[0])
    assert len(pictures) == 3


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(pn.Error, match="there is no such file; check its name"):
        pn.load_scene(tmp_path / "none.gltf")
    with pytest.raises(pn.Error):
        pn.compare(tmp_path / "a.exr", tmp_path / "b.exr")


def test_compare(scenes, tmp_path):
    result = pn.Engine().render(pn.load_scene(scenes / "cornell.gltf"), size=(64, 48))
    same = pn.compare(result, result)
    assert same["rmse"] == 0 and same["flip"] == 0 and same["psnr"] == float("inf")
    result.write_exr(tmp_path / "x.exr")
    assert pn.compare(result, tmp_path / "x.exr")["max"] < 1e-2  # halves
    other = pn.compare(result.color * 0.5, result.color)
    assert other["flip"] > 0.01 and other["flip_errors"].shape == (48, 64)
    with pytest.raises(pn.Error, match="same size"):
        pn.compare(result.color[:10], result.color)


def test_a_disk_that_fills_is_an_error_and_loses_nothing(scenes, tmp_path):
    result = pn.Engine().render(pn.load_scene(scenes / "cornell.gltf"), size=(128, 96))
    file = tmp_path / "x.exr"
    file.write_text("old")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, hard))  # Python ignores the signal that goes with it
    try:
        with pytest.raises(pn.Error, match="x.exr: cannot be written: .*is the disk full"):
            result.write_exr(file)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert file.read_text() == "old" and os.listdir(tmp_path) == ["x.exr"]


def test_the_lock_is_released(scenes):
    scene, ticks, done = pn.load_scene(scenes / "cornell.gltf"), 0, threading.Event()

    def draw():
        pn.Engine(threads=1).render(scene, size=(400, 300), spp=8)
        done.set()

    thread = threading.Thread(target=draw)
    thread.start()
    while not done.is_set():
        ticks += 1
        time.sleep(0.001)
    thread.join()
    assert ticks > 10


@pytest.mark.parametrize("call", ["engine.render(scene, size=(800, 600), spp=60000)",
                                  "engine.render_many(scene, [None] * 20000, (64, 64), outputs=['depth', 'color'])",
                                  "pn.compare(dark, bright, 1000)"])
def test_ctrl_c(scenes, call):
    code = (
        "import signal, sys, numpy as np, pinocchio_renderer as pn\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # a job in the background ignores it
        f"scene = pn.load_scene({str(scenes / 'cornell.gltf')!r})\n"
        "engine = pn.Engine()\n"
        "dark, bright = np.zeros((2400, 3200, 3), 'f4'), np.ones((2400, 3200, 3), 'f4')\n"
        "print('go', flush=True)\n"
        f"try: {call}\n"
        "except KeyboardInterrupt: sys.exit(42)\n"
    )
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    child.stdout.readline()
    time.sleep(0.5)
    begin = time.monotonic()
    child.send_signal(signal.SIGINT)
    assert child.wait(20) == 42
    assert time.monotonic() - begin < 2.0


def test_threads_are_said():
    assert pn.Engine(threads=3).threads == 3
    script = "import pinocchio_renderer as pn; print(pn.Engine().threads)"
    said = subprocess.run([sys.executable, "-c", script], env={**os.environ, "PINOCCHIO_THREADS": "5"},
                          capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "5"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_after_a_fork_an_engine_says_so(scenes):
    code = (
        "import os, pinocchio_renderer as pn\n"
        f"scene = pn.load_scene({str(scenes / 'cornell.gltf')!r})\n"
        "engine = pn.Engine(threads=2)\n"
        "engine.render(scene, size=(8, 8))\n"
        "child = os.fork()\n"
        "if child == 0:\n"
        "    try: engine.render(scene, size=(8, 8))\n"
        "    except pn.Error as error:\n"
        "        pn.Engine(threads=2).render(scene, size=(8, 8))\n"
        "        os._exit(7 if 'forked' in str(error) else 1)\n"
        "raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 7


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_a_posed_scene_ends_in_a_fork(scenes):
    code = (
        "import os, signal, numpy, pinocchio_renderer as pn\n"
        "grid = numpy.stack(numpy.meshgrid(numpy.arange(120.0), numpy.arange(120.0)), -1).reshape(-1, 2)\n"
        "vertices = numpy.c_[grid, numpy.zeros(len(grid))]\n"
        "at = numpy.arange(119 * 120).reshape(119, 120)[:, :-1].reshape(-1)\n"
        "part = pn.Scene(vertices, numpy.stack([at, at + 1, at + 120], -1))\n"
        "still = pn.assemble({'a': part, 'b': part, 'c': part})\n"
        "moved = numpy.eye(4); moved[0, 3] = 1\n"
        "scene = still.posed({'a': moved, 'b': moved})\n"
        "child = os.fork()\n"
        "if child == 0:\n"
        "    signal.alarm(30)\n"
        "    again = scene.posed({'b': moved, 'c': moved})\n"
        "    del scene, still, again\n"
        "    os._exit(7)\n"
        "raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 7


def test_import_is_quick():
    code = "import time; t = time.process_time(); import pinocchio_renderer as pn; print(time.process_time() - t)"  # on a busy machine, too
    took = [float(subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout) for _ in range(3)]
    assert min(took) < 0.1


def test_settings_are_in_the_docstring_and_the_stubs():
    assert "throughput_cutoff" in pn.Engine.render.__doc__
    folder = os.path.dirname(pn.__file__)
    assert os.path.exists(os.path.join(folder, "py.typed"))
    with open(os.path.join(folder, "_core.pyi")) as stub:
        assert "def render_many" in stub.read()


def test_ids_cannot_be_written_to(scenes):
    # Depth would index the scene by what was written.
    result = pn.Engine().render(pn.load_scene(scenes / "cornell.gltf"), size=(8, 6))
    with pytest.raises(ValueError, match="read-only"):
        result.ids[:] = 10**9
    assert result.depth.shape == (6, 8)
