"""The examples with robots, where their packages are installed: `pip install yourdfpy mujoco`."""
import re
import subprocess
import sys

import numpy
import pytest
from conftest import TREE
from PIL import Image
from test_examples import EXAMPLES, run

URDF = """<robot name="arm">
  <link name="base"><visual><geometry><box size="0.4 0.4 0.1"/></geometry></visual></link>
  <link name="upper"><visual><origin xyz="0 0 0.5"/><geometry><box size="0.1 0.1 1"/></geometry></visual></link>
  <link name="hand"><visual><geometry><sphere radius="0.15"/></geometry></visual></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="1.5707963" effort="1" velocity="1"/></joint>
  <joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/><origin xyz="0 0 1"/></joint>
</robot>"""
MUJOCO = """<mujoco><worldbody>
  <geom name="floor" type="plane" size="2 2 0.1" rgba="0.5 0.5 0.5 1"/>
  <body pos="0 0 1"><freejoint/><geom name="ball" type="sphere" size="0.2" rgba="0.9 0.2 0.1 1"/></body>
  <body pos="0.6 0 0.4"><geom name="pill" type="capsule" size="0.1 0.3" rgba="0.1 0.3 0.9 1"/></body>
  <geom name="hidden" group="3" type="box" pos="0 0 2" size="0.1 0.1 0.1"/>
</worldbody></mujoco>"""


def rows_of(objects, names, name):
    """The mean row of a node's pixels in each picture."""
    index = list(names).index(name)
    return [numpy.nonzero(picture == index)[0].mean() for picture in objects]


def assert_motion_leads(motion, objects, node, step):
    """The pixels of a node move to pixels of the node in the next or the former picture, where they stay in it."""
    shares = []
    for k in range(len(objects)):
        if 0 <= k + step < len(objects):
            y, x = numpy.nonzero(objects[k] == node)
            to = numpy.rint(numpy.stack([x, y], -1) + motion[k][y, x]).astype(int)
            to = to[((to >= 0) & (to < (objects.shape[2], objects.shape[1]))).all(axis=1)]
            if len(to) > 100:
                shares.append((objects[k + step][to[:, 1], to[:, 0]] == node).mean())
    assert shares and min(shares) > 0.9, shares


def test_a_urdf_robot_moves(tmp_path):
    pytest.importorskip("yourdfpy")
    (tmp_path / "arm.urdf").write_text(URDF)
    run(EXAMPLES / "robot_urdf.py", "arm.urdf", "arm.npz", 3, cwd=tmp_path)
    arrays = numpy.load(tmp_path / "arm.npz")
    assert arrays["color"].shape == (3, 240, 320, 4) and arrays["depth"].shape == (3, 240, 320)
    assert len(arrays["names"]) == 3
    seen = [set(numpy.unique(picture)) - {0xFFFFFFFF} for picture in arrays["objects"]]
    assert seen == [{0, 1, 2}] * 3
    rows = [rows_of(arrays["objects"], arrays["names"], name) for name in arrays["names"]]
    hand = min(range(3), key=lambda i: rows[i][0])
    assert rows[hand][0] < rows[hand][1] < rows[hand][2]  # it sinks, and the camera sees it from above
    lowest = [[numpy.nonzero(picture == i)[0].max() for picture in arrays["objects"]] for i in range(3)]
    assert any(numpy.ptp(of_node) == 0 for of_node in lowest)  # the base stays
    assert_motion_leads(arrays["motion"], arrays["objects"], hand, step=1)
    assert not arrays["motion"][2].any()  # nothing comes after the last step
    seen = arrays["objects"] != 0xFFFFFFFF
    assert (numpy.isfinite(arrays["depth"]) == seen).all() and arrays["color"][seen].std() > 0.02


def test_a_mujoco_model_falls(tmp_path):
    mujoco = pytest.importorskip("mujoco")
    (tmp_path / "ball.xml").write_text(MUJOCO)
    run(EXAMPLES / "robot_mujoco.py", "ball.xml", "ball.npz", 6, cwd=tmp_path)
    arrays = numpy.load(tmp_path / "ball.npz")
    assert sorted(arrays["names"]) == ["ball", "floor", "pill"]  # what MuJoCo hides is left out
    ball = rows_of(arrays["objects"], arrays["names"], "ball")
    assert all(a < b for a, b in zip(ball, ball[1:]))  # it falls
    assert_motion_leads(arrays["motion"], arrays["objects"], list(arrays["names"]).index("ball"), step=-1)
    assert not arrays["motion"][0].any()
    assert not arrays["motion"][arrays["objects"] == list(arrays["names"]).index("floor")].any()
    pill = rows_of(arrays["objects"], arrays["names"], "pill")
    assert numpy.ptp(pill) < 1
    # The pixels are where MuJoCo's own rays meet the geoms.
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "ball.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    middle, size = numpy.array(model.stat.center), float(model.stat.extent)
    eye = middle + size * numpy.array([1.3, -1.3, 0.9])
    forward = (middle - eye) / numpy.linalg.norm(middle - eye)
    right = numpy.cross(forward, (0, 0, 1))
    right /= numpy.linalg.norm(right)
    up, scale = numpy.cross(right, forward), numpy.tan(numpy.radians(45) / 2) / 120
    groups, same, off = numpy.array([1, 1, 1, 0, 0, 0], numpy.uint8), [], []
    for v in range(4, 240, 8):
        for u in range(4, 320, 8):
            ray = forward + right * (u - 159.5) * scale - up * (v - 119.5) * scale
            geom = numpy.zeros(1, numpy.int32)
            t = mujoco.mj_ray(model, data, eye, ray, groups, 1, -1, geom)
            ours = arrays["objects"][0, v, u]
            name = "" if geom[0] < 0 else model.geom(int(geom[0])).name
            same.append(name == ("" if ours == 0xFFFFFFFF else arrays["names"][ours]))
            if same[-1] and name:
                off.append(abs(t / arrays["depth"][0, v, u] - 1))  # the ray's length along the view axis is 1
    assert numpy.mean(same) > 0.99 and numpy.median(off) < 0.005


FIRST_PICTURE = re.search(r"```python\n(import yourdfpy\n.*?)```", (TREE / "README.md").read_text(encoding="utf-8"), re.S)[1]


def test_the_first_picture_of_a_robot_is_short(tmp_path):
    """The README's lines, with a robot of our own."""
    assert len(FIRST_PICTURE.strip().splitlines()) < 10
    pytest.importorskip("yourdfpy")
    (tmp_path / "robot.urdf").write_text(URDF)
    subprocess.run([sys.executable, "-c", FIRST_PICTURE], cwd=tmp_path, check=True)
    picture = numpy.asarray(Image.open(tmp_path / "robot.png").convert("RGBA")).astype(float)
    assert picture.std(axis=(0, 1))[:3].min() > 5
