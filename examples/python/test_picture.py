"""A picture test: it fails if a person would see a difference to the approved picture.

    pytest test_picture.py             # the first run writes the approved picture
    APPROVE=1 pytest test_picture.py   # after an intended change
"""
import os
import pathlib

import numpy
import pinocchio_renderer as pn
import pytest

APPROVED = pathlib.Path(__file__).with_name("approved")
MOST_FLIP = 0.005  # mean over the picture; far above the value of two pictures that look the same


def a_scene() -> pn.Scene:
    t = numpy.linspace(0, 2 * numpy.pi, 65)[:-1]
    rim = numpy.stack([numpy.cos(t), 0 * t, numpy.sin(t)], axis=1)
    vertices = numpy.vstack([rim, [[0, 1.5, 0]], 4 * rim - [0, 0.01, 0], [[0, -0.01, 0]]])
    i = numpy.arange(64)
    cone = numpy.stack([i, (i + 1) % 64, 0 * i + 64], axis=1)
    ground = numpy.stack([i + 65, (i + 1) % 64 + 65, 0 * i + 129], axis=1)
    colors = numpy.repeat([[0.8, 0.2, 0.1], [0.5, 0.5, 0.5]], 64, axis=0)
    light = pn.Light(position=(3, 5, 2))
    return pn.Scene(vertices, numpy.vstack([cone, ground]), colors=colors, lights=[light])


@pytest.mark.parametrize("name, eye", [("side", (0, 2, 6)), ("above", (1, 7, 1))])
def test_cone(name: str, eye: tuple[float, float, float]) -> None:
    camera = pn.Camera(eye, (0, 0.5, 0))
    result = pn.Engine().render(a_scene(), camera, size=(160, 120), spp=4)
    approved = APPROVED / f"{name}.exr"
    if os.environ.get("APPROVE") or not approved.exists():
        APPROVED.mkdir(exist_ok=True)
        result.write_exr(approved, aov="none")
        pytest.skip(f"{approved} is new: check it, and keep it")
    error = pn.compare(result, approved)
    assert error["flip"] <= MOST_FLIP, f"FLIP {error['flip']:.4f}; if the change is intended, set APPROVE=1"
