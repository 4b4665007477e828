"""Backgrounds and the shadow catcher, from Python."""

import numpy as np
import pytest
from PIL import Image

import pinocchio_renderer as pn


@pytest.fixture
def scene():
    vertices = np.array([[-1, 1, 1], [1, 1, 1], [1, 1, -1], [-1, 1, -1]], np.float32)
    made = pn.Scene(vertices, np.array([[0, 1, 2], [0, 2, 3]], np.uint32))
    made.lights = [pn.Light((0, 6, 0))]
    made.cameras = [pn.Camera(eye=(0, 5, 6), target=(0, 0.5, 0), fov=45)]
    return made


def over(picture, color):
    return picture[..., :3] + (1 - picture[..., 3:]) * np.asarray(color, np.float32)


@pytest.mark.parametrize("catcher", [False, True, 0.25])
def test_a_colour_is_what_the_transparent_picture_over_it_is(scene, catcher):
    engine = pn.Engine()
    settings = dict(size=(64, 48), spp=4, shadow_catcher=catcher)
    cut_out = engine.render(scene, background="transparent", **settings).color
    for color in [(0.25, 0.5, 0.75), np.array([0.18, 0.18, 0.18]), [1, 0, 2]]:
        on_color = engine.render(scene, background=color, **settings).color
        assert np.allclose(on_color[..., :3], over(cut_out, color), atol=1e-5)
        assert np.array_equal(on_color[..., 3], cut_out[..., 3])
    alpha = cut_out[..., 3]
    assert (alpha == 0).any() and (alpha == 1).any()
    assert ((alpha > 0.5) & (alpha < 0.9)).any() or catcher is False


def test_the_catcher_takes_the_share_of_the_blocked_light(scene):
    scene.lights = [pn.Light((0, 6, 0), intensity=0.9)]
    # Below the plate the lamp is hidden and the ambient light of 0.1 is left.
    cut_out = pn.Engine().render(
        scene,
        pn.Camera(eye=(0, 0.5, 3), target=(0, 0, 0), fov=30),
        size=(33, 33),
        background="transparent",
        shadow_catcher=0,
    )
    assert cut_out.ids[16, 16] == 0xFFFFFFFF
    assert cut_out.color[16, 16, 3] == pytest.approx(0.9, abs=0.01)


def test_names_and_errors(scene):
    engine = pn.Engine()
    white = engine.render(scene, size=(8, 8), background="white").color
    assert np.allclose(white[0, 0], [1, 1, 1, 0])
    assert np.allclose(engine.render(scene, size=(8, 8), background="#ff0000").color[0, 0], [1, 0, 0, 0])
    for wrong in ["nothing", (1, 2), (1, 2, 3, 4), 0.5, True, (-1, 0, 0)]:
        with pytest.raises(pn.Error, match="background is .*it is environment, studio, transparent"):
            engine.render(scene, size=(8, 8), background=wrong)
    with pytest.raises(pn.Error, match="shadow_catcher is .*it is off, lowest or a height"):
        engine.render(scene, size=(8, 8), shadow_catcher="floor")


def test_an_environment_is_blurred_behind_the_scene_alone(scene):
    engine = pn.Engine()
    sky = np.full((16, 32, 3), 0.1, np.float32)
    sky[:, 16:] = 0.9
    scene.environment = sky
    sharp = engine.render(scene, size=(64, 48))
    soft = engine.render(scene, size=(64, 48), background_blur=0.5)
    behind = sharp.ids == 0xFFFFFFFF
    assert np.array_equal(sharp.color[~behind], soft.color[~behind])
    assert np.abs(sharp.color[behind] - soft.color[behind]).max() > 0.1
    many = engine.render_many(scene, scene.cameras, (64, 48), outputs=["color"], background_blur=0.5)["color"]
    assert np.array_equal(many[0], soft.color)
    with pytest.raises(pn.Error, match="background_blur is .*it is a number from 0 to 1"):
        engine.render(scene, size=(8, 8), background_blur=2)


def test_png_files(scene, tmp_path):
    engine = pn.Engine()
    path = tmp_path / "picture.png"
    engine.render(scene, size=(64, 48), spp=4, background="#336699", shadow_catcher=True).write_png(path, exposure=2)
    on_color = np.asarray(Image.open(path))
    assert on_color.shape == (48, 64, 3)
    assert tuple(on_color[0, 0]) == (0x33, 0x66, 0x99)  # whatever the exposure
    engine.render(scene, size=(64, 48), spp=4, background="transparent", shadow_catcher=True).write_png(path)
    alpha = np.asarray(Image.open(path))[..., 3]
    assert alpha[0, 0] == 0 and alpha.max() == 255 and ((alpha > 100) & (alpha < 250)).any()


def test_many_pictures_have_it(scene):
    engine = pn.Engine()
    settings = dict(background="transparent", shadow_catcher=True, spp=2)
    many = engine.render_many(scene, scene.cameras * 2, (64, 48), outputs=["color"], **settings)["color"]
    assert np.array_equal(many[1], engine.render(scene, size=(64, 48), **settings).color)
