"""What a scene, an engine and a result give to read, and how they show and end themselves."""
import io

import numpy
import pinocchio_renderer as pn
import pytest
from PIL import Image

from test_tracer import quad

CAMERA = pn.Camera((0, 0, 4), (0, 0, 0))


def test_lights_are_a_list_that_can_be_changed():
    scene, engine = pn.Scene(*quad()), pn.Engine(threads=1)
    scene.lights.append(pn.Light(position=(0, 0, 3)))
    bright = engine.render(scene, CAMERA, size=(8, 8)).color[4, 4, 0]
    scene.lights[0].intensity = 0.5
    dark = engine.render(scene, CAMERA, size=(8, 8)).color[4, 4, 0]
    assert 0 < dark < bright
    scene.lights.append(pn.Light(direction=(0, 0, -1), casts_shadow=False))
    assert engine.render(scene, CAMERA, size=(8, 8)).color[4, 4, 0] > dark
    scene.cameras.append(pn.Camera((0, 0, 2), (0, 0, 0), name="near"))
    assert engine.render(scene, "near", size=(8, 8)).depth[4, 4] == pytest.approx(2)
    scene.cameras[0].eye = (0, 0, 3)
    assert engine.render(scene, "near", size=(8, 8)).depth[4, 4] == pytest.approx(3)
    scene.lights.append("lamp")
    with pytest.raises(pn.Error, match=r"scene.lights\[2\] is a str; it must be a Light"):
        engine.render(scene, CAMERA, size=(8, 8))


def test_an_environment_of_an_array_or_a_file(tmp_path):
    scene, engine = pn.Scene(*quad()), pn.Engine(threads=1)
    away = pn.Camera((0, 0, 4), (0, 0, 8), fov=20)  # at +Z, the middle of the picture
    assert scene.environment is None
    light = numpy.zeros((16, 32, 3), numpy.float32)
    light[:, 8:24] = (0.25, 0.5, 1)
    scene.environment = light
    seen = engine.render(scene, away, size=(8, 8)).color
    numpy.testing.assert_allclose(seen[..., :3], numpy.broadcast_to((0.25, 0.5, 1), (8, 8, 3)), atol=1e-6)
    numpy.testing.assert_array_equal(scene.environment, light)
    assert engine.render(scene, away, size=(8, 8), environment_strength=2).color[4, 4, 0] == pytest.approx(0.5)
    assert not engine.render(scene, away, size=(8, 8), environment_rotation=180).color[..., :3].any()

    # The same light from a Radiance file (RGBE): 1, 1, 1 is 128, 128, 128, 129.
    file = tmp_path / "white.hdr"
    file.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n" + bytes([128, 128, 128, 129]) * 32)
    scene.environment = file
    assert scene.environment.shape == (4, 8, 3)
    numpy.testing.assert_allclose(engine.render(scene, away, size=(8, 8)).color[..., :3], 1, atol=1e-2)
    kept = scene.environment
    scene.environment = None
    assert scene.environment is None and kept.mean() == pytest.approx(1, abs=1e-2)
    assert not engine.render(scene, away, size=(8, 8)).color[..., :3].any()

    for wrong, says in [(light[..., :2], "environment has the shape"), (-light, "negative or not finite"),
                        (tmp_path / "none.hdr", "there is no such file"), ("none.exr", "there is no such file"),
                        (numpy.zeros((0, 4, 3)), "environment is empty")]:
        with pytest.raises(pn.Error, match=says):
            scene.environment = wrong


def test_a_scene_is_read_back(scenes):
    uvs = numpy.array([[0, 1], [1, 1], [1, 0], [0, 0]], numpy.float32)
    red = pn.Material(diffuse=(1, 0, 0), name="red", texture=numpy.full((2, 2, 3), 200, numpy.uint8))
    glass = pn.Material(transmittance=(0.5, 1, 1), ior=1.5, name="glass", gloss=100)
    scene = pn.Scene(*quad(), uvs=uvs, materials=[red, glass], triangle_materials=[1, 0])
    numpy.testing.assert_array_equal(scene.uvs, uvs)
    numpy.testing.assert_array_equal(scene.triangle_materials, [1, 0])
    assert [m.name for m in scene.materials] == ["red", "glass"]
    assert scene.materials[0].diffuse == (1, 0, 0) and scene.materials[0].texture.shape == (2, 2, 4)
    assert (scene.materials[1].transmittance, scene.materials[1].ior) == ((0.5, 1, 1), 1.5)
    assert scene.materials[1].texture is None and scene.materials[1].roughness is None
    plain = pn.Scene(*quad(), colors=[[1, 0, 0]] * 4)
    assert plain.uvs is None and plain.colors.shape == (4, 4) and plain.triangle_nodes.tolist() == [0, 0]

    both = pn.assemble({"one": scene, "two": plain})
    assert both.triangle_nodes.tolist() == [0, 0, 1, 1]
    result = pn.Engine().render(both, size=(32, 24))
    hit = result.ids != 0xFFFFFFFF
    numpy.testing.assert_array_equal(both.triangle_nodes[result.ids[hit]], result.objects[hit])
    assert both.materials[both.triangle_materials[0]].name == "glass"
    # Materials of one scene serve another.
    again = pn.Scene(*quad(), uvs=uvs, materials=both.materials, triangle_materials=both.triangle_materials[:2])
    assert again.materials[0].texture[0, 0, 0] == 200

    cornell = pn.load_scene(scenes / "cornell.gltf")
    assert len(cornell.triangle_materials) == len(cornell.triangles)
    assert all(isinstance(m.name, str) for m in cornell.materials)


def test_every_node_has_a_name_of_its_own(tmp_path):
    file = tmp_path / "x.gltf"
    file.write_text("""{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
      "nodes": [{"mesh": 0}, {"mesh": 0, "name": "wheel"}, {"mesh": 0, "name": "wheel"}, {"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}""")
    scene = pn.load_scene(file)
    names = scene.nodes
    assert len(names) == 4 and len(set(names)) == 4 and all(names)
    assert names[1] == "wheel" and names[2] == "wheel#2" and names[0] == "#0"
    up = numpy.eye(4)
    up[2, 3] = 5
    for i, name in enumerate(names):
        by_name, by_number = scene.posed({name: up}), scene.posed({i: up})
        numpy.testing.assert_array_equal(by_name.vertices, by_number.vertices)
        assert (by_name.vertices[scene.triangles[scene.triangle_nodes == i], 2] == 5).all()


def test_the_poses_of_nodes_are_read(scenes):
    pose = numpy.eye(4)
    pose[:3, 3] = (1, 2, 3)
    scene = pn.assemble({"floor": pn.Scene(*quad()), "plate": (pn.Scene(*quad()), pose)})
    numpy.testing.assert_array_equal(scene.node_transforms, [numpy.eye(4), pose])
    assert scene.node_parents.tolist() == [-1, -1] and pn.Scene(*quad()).node_transforms.shape == (0, 4, 4)
    moved = scene.posed({"floor": pose})
    numpy.testing.assert_array_equal(moved.node_transforms, [pose, pose])
    mill = pn.load_scene(scenes / "windmill.glb")
    later = mill.at_time(0.5)
    assert (mill.node_parents < numpy.arange(len(mill.nodes))).all() and mill.node_parents.dtype == numpy.int32
    again = mill.posed(dict(zip(mill.nodes, later.node_transforms)))
    numpy.testing.assert_allclose(again.vertices, later.vertices, atol=1e-6)


def test_an_engine_ends():
    scene = pn.Scene(*quad())
    with pn.Engine(threads=2) as engine:
        assert repr(engine) == "<Engine: 2 threads>"
        engine.render(scene, size=(8, 8))
    assert repr(engine) == "<Engine, closed>"
    for call in (lambda: engine.render(scene), lambda: engine.render_many(scene, [None])):
        with pytest.raises(pn.Error, match="this Engine is closed"):
            call()
    engine.close()  # again: nothing happens
    with pytest.raises(ZeroDivisionError):
        with pn.Engine() as engine:
            1 / 0


def test_objects_show_what_they_are(scenes):
    scene = pn.load_scene(scenes / "cornell.gltf")
    result = pn.Engine().render(scene, size=(32, 24), spp=2)
    hits = pn.Tracer(scene).closest_hits([[0, 1, 9]], [[0, 0, -1], [0, 0, 1]])
    for value, begins in [
        (scene, f"<Scene 'cornell.gltf': {len(scene.triangles)} triangles, "),
        (pn.Camera((0, 0, 4), (0, 0, 0), name="front"), "<Camera 'front', eye=(0.0, 0.0, 4.0), target="),
        (pn.Light(position=(0, 0, 4)), "<Light point, position=(0.0, 0.0, 4.0), intensity=1.0>"),
        (pn.Material(name="red", diffuse=(1, 0, 0)), "<Material 'red': diffuse=(1.0, 0.0, 0.0)>"),
        (result, "<Result: 32x24 pixels, 2 spp, "),
        (pn.Tracer(scene), f"<Tracer: {len(scene.triangles)} triangles>"),
        (hits, "<Hits: 1 of 2 rays>"),
    ]:
        assert repr(value).startswith(begins), repr(value)


def test_a_result_shows_itself_in_a_notebook(scenes, tmp_path):
    result = pn.Engine().render(pn.load_scene(scenes / "cornell.gltf"), size=(64, 48))
    picture = numpy.asarray(Image.open(io.BytesIO(result._repr_png_())).convert("RGB")).astype(int)
    linear = numpy.clip(result.color[..., :3], 0, 1)
    srgb = numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055) * 255
    opaque = result.color[..., 3] == 1
    assert opaque.any() and numpy.abs(picture - srgb)[opaque].max() <= 1
    result.write_png(tmp_path / "x.png")
    assert (tmp_path / "x.png").read_bytes() == result._repr_png_()
    result.write_png(tmp_path / "bright.PNG", exposure=1)
    assert numpy.asarray(Image.open(tmp_path / "bright.PNG").convert("RGB")).mean() > picture.mean()
    result.write_png(tmp_path / "filmic.png", exposure=4, tone_map="aces")
    result.write_png(tmp_path / "clipped.png", exposure=4)
    filmic, clipped = (numpy.asarray(Image.open(tmp_path / f).convert("RGB")) for f in ("filmic.png", "clipped.png"))
    assert (filmic == 255).sum() < (clipped == 255).sum()
    with pytest.raises(pn.Error, match="tone_map is 'film'; it is 'clip', 'reinhard', 'aces' or 'neutral'"):
        result.write_png(tmp_path / "x.png", tone_map="film")
    with pytest.raises(pn.Error, match="exposure is nan"):
        result.write_png(tmp_path / "x.png", exposure=float("nan"))


def test_a_png_shows_the_environment():
    scene = pn.Scene(*quad(), environment=numpy.ones((4, 8, 3), numpy.float32))
    result = pn.Engine().render(scene, pn.Camera((0, 0, 4), (0, 0, 8)), size=(8, 8))
    assert numpy.asarray(Image.open(io.BytesIO(result._repr_png_())).convert("RGBA")).min() == 255


def test_files_have_the_extension_of_what_they_hold(tmp_path):
    result = pn.Engine().render(pn.Scene(*quad()), size=(8, 8))
    with pytest.raises(pn.Error, match="x.png: write_exr writes EXR files; end the name in .exr, or use write_png"):
        result.write_exr(tmp_path / "x.png")
    with pytest.raises(pn.Error, match="write_png writes PNG files"):
        result.write_png(tmp_path / "x.exr")
    with pytest.raises(pn.Error, match="cannot be written"):
        result.write_png(tmp_path / "none" / "x.png")
    assert not list(tmp_path.iterdir())
    result.write_exr(tmp_path / "x.EXR")
