"""The example on Ray, with two workers on this machine, and the film, where Ray, WebDataset and ffmpeg are installed."""
import json
import shutil
import subprocess
import sys
import tarfile

import numpy
import pinocchio_renderer as pn
import pytest
from test_examples import EXAMPLES, run


def draw(*arguments, cwd):
    command = [sys.executable, str(EXAMPLES / "farm_ray.py"), *map(str, arguments)]
    drawn = subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=300)
    if "The current node timed out during startup" in drawn.stderr:
        pytest.skip("Ray did not start within its 30 s on this busy machine")
    return drawn


def shards(folder):
    return {path.name: path.read_bytes() for path in folder.glob("shard-*.tar") if path.is_file()}


def test_shards_by_ray(tmp_path, scenes):
    pytest.importorskip("ray")
    scene = scenes / "cornell.gltf"
    # One shard cannot get its name: the others are drawn, and the run says so.
    blocked = tmp_path / "two" / "shard-000001.tar"
    (blocked / "full").mkdir(parents=True)
    failed = draw(scene, "two", 10, 2, 3, cwd=tmp_path)
    assert failed.returncode == 1, failed.stderr
    assert "3 shards drawn" in failed.stdout and "1 failed" in failed.stdout
    assert failed.stderr.count("shard-000001.tar: ") >= 2  # tried twice
    first = shards(tmp_path / "two")
    assert sorted(first) == ["shard-000000.tar", "shard-000002.tar", "shard-000003.tar"]
    # The next run draws what is missing alone.
    shutil.rmtree(blocked)
    resumed = draw(scene, "two", 10, 2, 3, cwd=tmp_path)
    assert resumed.returncode == 0, resumed.stderr
    assert "1 shards drawn" in resumed.stdout and "3 were there" in resumed.stdout
    both = shards(tmp_path / "two")
    assert {name: both[name] for name in first} == first and len(both) == 4
    # One worker writes the same bytes.
    assert draw(scene, "one", 10, 1, 3, cwd=tmp_path).returncode == 0
    assert shards(tmp_path / "one") == both
    assert not list((tmp_path / "two").glob(".*.part"))
    with tarfile.open(tmp_path / "two/shard-000003.tar") as tar:
        assert tar.getnames() == [f"00000009.{kind}" for kind in ("json", "color.npy", "depth.npy", "objects.npy")]


def test_the_shards_are_webdatasets(tmp_path, scenes):
    pytest.importorskip("ray")
    webdataset = pytest.importorskip("webdataset")
    assert draw(scenes / "cornell.gltf", "set", 4, 1, 2, cwd=tmp_path).returncode == 0
    samples = list(webdataset.WebDataset([str(path) for path in sorted((tmp_path / "set").glob("*.tar"))], shardshuffle=False).decode())
    assert [sample["__key__"] for sample in samples] == [f"{i:08d}" for i in range(4)]
    sample = samples[2]
    camera = sample["json"] if isinstance(sample["json"], dict) else json.loads(sample["json"])
    pose = numpy.array(camera["pose"])
    scene = pn.load_scene(scenes / "cornell.gltf")
    of_pose = pn.Camera.from_intrinsics((128, 128), camera["focal"], camera["focal"], *camera["center"], pose)
    picture = pn.Engine().render_many(scene, [of_pose], (128, 128), outputs=["depth", "objects"])
    assert (picture["depth"][0] == sample["depth.npy"]).all() and (picture["objects"][0] == sample["objects.npy"]).all()


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is not installed")
def test_a_film(tmp_path, scenes):
    run(EXAMPLES / "video.py", scenes / "cornell.gltf", "film.mp4", 12, cwd=tmp_path)
    raw = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", str(tmp_path / "film.mp4"), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                         check=True, capture_output=True).stdout
    frames = numpy.frombuffer(raw, numpy.uint8).reshape(-1, 240, 320, 3).astype(float)
    assert len(frames) == 12 and frames[0].std() > 10
    assert numpy.abs(frames[6] - frames[0]).mean() > 5  # the camera goes around
