"""The stubs: mypy takes the examples, and what users write, as strictly as it can."""
import pathlib
import re
import subprocess
import sys

import pinocchio_renderer as pn
import pytest
from conftest import TREE

pytest.importorskip("mypy")

USER = """
import copy
import pathlib
import numpy as np
import pinocchio_renderer as pn

camera = pn.Camera(eye=np.array([0, 0, 4]), target=(0, 0, 0), up=[0, 1, 0])
camera.eye = np.zeros(3)
x: float = camera.eye[0]
scene = pn.Scene(np.zeros((3, 3)), [[0, 1, 2]], lights=[pn.Light(position=np.ones(3))], materials=pn.Material())
scene.lights.append(pn.Light(direction=(0, -1, 0)))
scene.environment = np.ones((4, 8, 3))
scene.environment = pathlib.Path("sky.exr")
scene = copy.deepcopy(pn.load_scene(pathlib.Path("a.gltf")).posed({"arm": np.eye(4)}))
robot = pn.assemble({"floor": scene, "cup": (scene, np.eye(4))})
with pn.Engine(threads=2) as engine:
    result = engine.render(robot, camera, size=(64, 48), spp=4, mode="raytrace")
    arrays = engine.render_many(robot, [camera, None, "front"], (64, 64), outputs=["color", "depth"])
result.write_exr("a.exr")
mean: float = float((result.depth + arrays["depth"][0]).mean())
t, triangle = pn.Tracer(robot).closest_hits(np.zeros((1, 3)), np.ones((1, 3)))
names: list[str] = [material.name for material in robot.materials]
error: float = pn.compare(result, "a.exr")["flip"]
"""
WRONG = ["pn.Camera(eye=None, target=(0, 0, 0))", "pn.Light(position=(0, 0, 0)).kinds", "pn.Engine(threads='two')",
         "pn.load_scene(3)", "pn.Engine().render('scene')"]


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """The errors of files in a folder. NumPy is read once for all tests."""
    cache = tmp_path_factory.mktemp("mypy")

    def errors(*files, cwd):
        command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(cache), *map(str, files)]
        done = subprocess.run(command, cwd=cwd, capture_output=True, text=True)
        assert done.returncode in (0, 1), done.stdout + done.stderr
        return [line for line in done.stdout.splitlines() if ": error: " in line]

    return errors


def test_what_users_write_is_typed(mypy, tmp_path):
    (tmp_path / "user.py").write_text(USER)
    assert mypy("user.py", cwd=tmp_path) == []
    (tmp_path / "wrong.py").write_text("import pinocchio_renderer as pn\n\n" + "\n".join(WRONG) + "\n")
    found = {int(re.match(r"wrong.py:(\d+):", line)[1]) - 3 for line in mypy("wrong.py", cwd=tmp_path)}
    assert found == set(range(len(WRONG)))


def test_the_examples_are_typed(mypy, tmp_path):
    examples = sorted((TREE / "examples/python").glob("*.py"))
    assert len(examples) >= 4
    assert mypy(*examples, cwd=tmp_path) == []


def test_the_stubs_are_typed(mypy, tmp_path):
    installed, copy = pathlib.Path(pn.__file__).parent, tmp_path / "pinocchio_renderer"
    copy.mkdir()  # mypy does not report what is wrong in installed packages
    for file in [*installed.glob("*.py"), *installed.glob("*.pyi")]:
        (copy / file.name).write_text(file.read_text())
    assert mypy("-p", "pinocchio_renderer", cwd=tmp_path) == []
    (copy / "_core.pyi").write_text((copy / "_core.pyi").read_text() + "\ndef untyped(a): ...\n")
    assert len(mypy("-p", "pinocchio_renderer", cwd=tmp_path)) == 1
    assert "**settings: object" in (installed / "_core.pyi").read_text()
