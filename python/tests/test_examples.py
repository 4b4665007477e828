"""The examples run as they stand, with this module."""
import subprocess
import sys

import nbclient
import nbformat
import numpy
import pinocchio_renderer as pn
import pytest
from conftest import TREE
from PIL import Image

EXAMPLES = TREE / "examples/python"


def run(*command, cwd):
    return subprocess.run([sys.executable, *map(str, command)], cwd=cwd, check=True, capture_output=True, text=True)


def test_thumbnails_of_a_folder(tmp_path):
    models, out = tmp_path / "models", tmp_path / "out"
    models.mkdir()
    (models / "tetrahedron.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n")
    (models / "broken.ply").write_text("ply\n")
    (models / "notes.txt").write_text("no model")
    done = run(EXAMPLES / "thumbnails.py", models, out, 32, cwd=tmp_path)
    assert [p.name for p in out.iterdir()] == ["tetrahedron.obj.png"]
    assert "broken.ply" in done.stderr
    picture = numpy.asarray(Image.open(out / "tetrahedron.obj.png"))
    assert picture.shape == (32, 32, 3) and picture.std() > 5


def test_a_data_set(tmp_path, scenes):
    run(EXAMPLES / "dataset.py", scenes / "cornell.gltf", "set.npz", 3, cwd=tmp_path)
    arrays = numpy.load(tmp_path / "set.npz")
    assert arrays["color"].shape == (3, 128, 128, 4) and arrays["poses"].shape == (3, 4, 4)
    # Each pixel's depth and pose give the point that a ray of that pixel meets.
    scene = pn.load_scene(scenes / "cornell.gltf")
    tracer = pn.Tracer(scene.vertices, scene.triangles)
    v, u = numpy.indices((128, 128))
    cx, cy = arrays["center"]
    directions = numpy.stack([(u - cx) / arrays["focal"], (v - cy) / arrays["focal"], numpy.ones_like(u)], -1)
    for pose, depth, ids in zip(arrays["poses"], arrays["depth"], arrays["ids"]):
        rays = (directions @ pose[:3, :3].T).reshape(-1, 3)
        t, triangle = tracer.closest_hits(numpy.tile(pose[:3, 3], (len(rays), 1)), rays)
        same = triangle == ids.ravel()
        assert same.mean() > 0.999
        numpy.testing.assert_allclose(t[same], depth.ravel()[same], rtol=1e-4)


def test_a_lidar(tmp_path, scenes):
    done = run(EXAMPLES / "lidar.py", scenes / "cornell.gltf", "points.npz", cwd=tmp_path)
    points = numpy.load(tmp_path / "points.npz")
    n = len(points["distance"])
    assert f"{n} points of {900 * 32} beams" in done.stdout and n > 10000
    assert points["position"].shape == (n, 3) and points["node"].max() < len(points["names"])
    # Noise aside, each point is on a surface of the scene.
    scene = pn.load_scene(scenes / "cornell.gltf")
    low, high = map(numpy.array, scene.bounds)
    assert (points["position"] > low - 0.1).all() and (points["position"] < high + 0.1).all()
    corners = scene.vertices[scene.triangles[points["triangle"]]].astype(float)
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= numpy.linalg.norm(normals, axis=1)[:, None]
    off = numpy.einsum("ni,ni->n", points["position"] - corners[:, 0], normals)
    assert numpy.abs(off).max() < 0.1 and off.std() < 0.011
    assert (points["intensity"] >= 0).all()


def test_the_picture_test_approves_and_compares(tmp_path):
    copy = tmp_path / "test_picture.py"
    copy.write_text((EXAMPLES / "test_picture.py").read_text())
    first = run("-m", "pytest", "-q", "-p", "no:cacheprovider", copy, cwd=tmp_path)
    assert "2 skipped" in first.stdout
    second = run("-m", "pytest", "-q", "-p", "no:cacheprovider", copy, cwd=tmp_path)
    assert "2 passed" in second.stdout
    side, above = (tmp_path / "approved" / name for name in ("side.exr", "above.exr"))
    side.write_bytes(above.read_bytes())
    with pytest.raises(subprocess.CalledProcessError):
        run("-m", "pytest", "-q", "-p", "no:cacheprovider", copy, cwd=tmp_path)


def test_the_notebook(monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "agg")
    notebook = nbformat.read(EXAMPLES / "error_against_time.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(EXAMPLES)}}).execute()
    rows = eval(notebook.cells[2].outputs[0].data["text/plain"])
    assert len(rows) == 7 and rows[-1][1] < rows[0][1]  # more samples, smaller error
