"""Scenes from arrays, trimesh and glTF; what moves; cameras by their matrix."""
import os

import numpy
import pinocchio_renderer as pn
import pytest
from PIL import Image

from test_tracer import quad


def floor(**more):
    return pn.Scene(*quad(), **more)


ABOVE = dict(eye=(0, 0, 4), target=(0, 0, 0), up=(0, 1, 0))


def test_arrays_are_seen_without_a_copy():
    scene = floor()
    assert scene.vertices.shape == (4, 3) and scene.triangles.dtype == numpy.uint32
    with pytest.raises(ValueError):
        scene.vertices[0, 0] = 1
    result = pn.Engine().render(scene, size=(8, 6))
    assert numpy.shares_memory(result.color, result.color) and result.color.base is not None
    depth = result.depth
    del result
    assert depth.shape == (6, 8)  # the arrays keep what they look at


def test_colors_materials_and_textures():
    engine, camera = pn.Engine(), pn.Camera(**ABOVE, fov=20)
    sun = [pn.Light(direction=(0, 0, -1))]
    colored = floor(colors=numpy.array([[1, 0, 0], [0, 0, 1]], numpy.float32), lights=sun)
    albedo = engine.render(colored, camera, size=(16, 16)).albedo
    assert {tuple(a) for a in albedo.reshape(-1, 3)} == {(1, 0, 0), (0, 0, 1)}

    texels = numpy.zeros((2, 2, 3), numpy.uint8)
    texels[0] = 255  # its upper half is white
    uvs = numpy.array([[0, 1], [1, 1], [1, 0], [0, 0]], numpy.float32)
    textured = floor(uvs=uvs, materials=pn.Material(diffuse=(1, 1, 1), texture=texels), lights=sun)
    albedo = engine.render(textured, pn.Camera(**ABOVE, fov=28), size=(16, 16)).albedo[..., 0]
    assert albedo[4, 8] > 0.9 and albedo[11, 8] < 0.1

    metal = pn.Material(diffuse=(0, 0, 0), reflectance=(0.5, 0.5, 0.5))
    mirror = floor(materials=[pn.Material(), metal], triangle_materials=numpy.array([0, 1]), lights=sun)
    assert engine.render(mirror, camera, size=(8, 8)).record["rays"]["reflection"] > 0


def test_glass_takes_light_by_the_way_through_it():
    corners, triangles = quad()
    vertices = numpy.concatenate([corners + numpy.float32([0, 0, z]) for z in (0, 1, 2)])
    # a wall, a slab's lower and upper face
    triangles = numpy.concatenate([triangles, triangles[:, ::-1] + 4, triangles + 8])
    wall = pn.Material(diffuse=(0, 0, 0), emission=(1, 1, 1))
    glass = pn.Material(diffuse=(0, 0, 0), transmittance=(1, 1, 1), attenuation_color=(0.25, 0.5, 1),
                               attenuation_distance=2)
    scene = pn.Scene(vertices, triangles, materials=[wall, glass],
                            triangle_materials=numpy.array([0, 0, 1, 1, 1, 1]))
    camera = pn.Camera(eye=(0, 0, 9), target=(0, 0, 0), up=(0, 1, 0), fov=2)
    seen = pn.Engine().render(scene, camera, size=(4, 4), mode="raytrace").color[2, 2, :3]
    assert seen == pytest.approx([0.25**0.5, 0.5**0.5, 1], abs=2e-3)


def test_the_camera_sees_through_the_backs_of_single_sided_materials():
    corners, triangles = quad()
    below = pn.Camera(eye=(0, 0, -9), target=(0, 0, 0), up=(0, 1, 0), fov=2)
    for double_sided, backfaces, seen in [(None, "auto", True), (None, "cull", False), (True, "cull", True),
                                          (False, "auto", False), (False, "draw", True)]:
        scene = pn.Scene(corners, triangles, materials=pn.Material(double_sided=double_sided))
        ids = pn.Engine().render(scene, below, size=(4, 4), backfaces=backfaces).ids
        assert (ids[2, 2] != 0xffffffff) == seen, (double_sided, backfaces)


def test_lights_and_cameras_change_between_calls():
    engine, scene = pn.Engine(), floor(lights=[pn.Light(position=(0, 0, 3))])
    lit = engine.render(scene, pn.Camera(**ABOVE), size=(8, 8)).mask
    scene.lights = [pn.Light(position=(0, 0, -3))]
    behind = engine.render(scene, pn.Camera(**ABOVE), size=(8, 8)).mask
    assert lit[4, 4] == 1 and behind[4, 4] == 0


@pytest.mark.parametrize("count, dtype, numbers", [(1, "uint8", 0), (8, "uint8", 0), (9, "uint16", 0), (17, "uint32", 0),
                                                   (40, "uint64", 0), (64, "uint64", 0), (65, "uint64", 2),
                                                   (130, "uint64", 3)])
def test_a_mask_has_a_bit_for_every_casting_light(count, dtype, numbers):
    lights = [pn.Light(position=(0, 0, 3), casts_shadow=False),
              *[pn.Light(position=(0, 0, 3)) for _ in range(count - 1)],
              pn.Light(position=(0, 0, -3)),  # behind the floor
              pn.Light(position=(1000, 0, 3), range=1)]  # reaches nothing: no bit
    engine, scene, size = pn.Engine(), floor(lights=lights), (8, 6)
    mask = engine.render(scene, pn.Camera(**ABOVE), size=size).mask
    assert mask.dtype == dtype and mask.shape == (6, 8) + ((numbers,) if numbers else ())
    slots = sum(int(word) << 64 * i for i, word in enumerate(numpy.atleast_1d(mask[3, 4])))
    assert slots == (1 << (count - 1)) - 1
    many = engine.render_many(scene, [pn.Camera(**ABOVE)] * 2, size=size, outputs=["mask"])["mask"]
    assert many.dtype == dtype and many.shape == (2, *mask.shape)
    assert (many == mask).all()
    again = engine.render_many(scene, [pn.Camera(**ABOVE)] * 2, size=size, outputs=["mask"], out={"mask": many})
    assert again["mask"] is many


def test_nodes_move(scenes):
    part = floor()
    pose = numpy.eye(4)
    pose[2, 3] = 1.0
    scene = pn.assemble({"floor": part, "plate": (part, pose)})
    assert scene.nodes == ["floor", "plate"]
    engine, camera = pn.Engine(), pn.Camera(**ABOVE, fov=20)
    assert engine.render(scene, camera, size=(8, 8)).depth[4, 4] == pytest.approx(3.0)
    assert set(engine.render(scene, camera, size=(8, 8)).objects.flat) == {1}
    pose[2, 3] = -0.5
    moved = scene.posed({"plate": pose})
    assert engine.render(moved, camera, size=(8, 8)).depth[4, 4] == pytest.approx(4.0)
    assert scene.vertices[4, 2] == 1.0  # the scene is as it was
    with pytest.raises(pn.Error, match="no node 'roof'"):
        scene.posed({"roof": pose})

    cornell = pn.load_scene(scenes / "cornell.gltf")
    lamp = numpy.eye(4)
    lamp[:3, 3] = (0.5, 1, 1)
    assert cornell.posed({"lamp": lamp}).lights[0].position == pytest.approx((0.5, 1, 1))


def test_nodes_are_found_by_name_as_by_number():
    count = 50
    scene = pn.assemble({f"part {i}": pn.Scene(numpy.eye(3), [[0, 1, 2]]) for i in range(count)})
    poses = numpy.tile(numpy.eye(4), (count, 1, 1))
    poses[:, 0, 3] = range(count)
    by_number = scene.posed(dict(enumerate(poses)))
    by_name = scene.posed({f"part {i}": poses[i] for i in reversed(range(count))})
    assert numpy.array_equal(by_name.vertices, by_number.vertices)
    assert by_name.vertices[:, 0].max() == count


def test_trimesh():
    trimesh = pytest.importorskip("trimesh")
    box = trimesh.creation.box()
    box.visual.face_colors = [255, 0, 0, 255]
    scene = pn.from_trimesh(box, smooth=False)
    result = pn.Engine().render(scene, size=(32, 32))
    assert tuple(result.albedo[16, 16]) == (1, 0, 0)
    material = trimesh.visual.material.PBRMaterial(baseColorFactor=[128, 255, 0, 255])
    box.visual = trimesh.visual.TextureVisuals(uv=numpy.zeros((8, 2)), material=material)
    assert pn.from_trimesh(box).materials[0].diffuse == pytest.approx((128 / 255, 1, 0))
    material.baseColorTexture = Image.new("RGB", (2, 2), (255, 255, 255))
    assert pn.from_trimesh(box).materials[0].diffuse == pytest.approx((128 / 255, 1, 0))
    box.visual = trimesh.visual.ColorVisuals(box)
    world = trimesh.Scene()
    world.add_geometry(box, node_name="near")
    world.add_geometry(box, node_name="far", transform=trimesh.transformations.translation_matrix([5, 0, 0]))
    both = pn.from_trimesh(world)
    assert sorted(both.nodes) == ["far", "near"] and both.bounds[1][0] == pytest.approx(5.5)


def test_camera_matrix_turns_depth_into_points():
    fx, fy, cx, cy = 95.0, 90.0, 40.0, 22.0
    pose = numpy.eye(4)
    angle = 0.3
    pose[:3, :3] = [[numpy.cos(angle), 0, numpy.sin(angle)], [0, 1, 0], [-numpy.sin(angle), 0, numpy.cos(angle)]]
    pose[:3, 3] = (-0.4, 0.1, -3)
    camera = pn.Camera.from_intrinsics((64, 48), fx, fy, cx, cy, pose)
    assert camera.intrinsics((64, 48)) == pytest.approx((fx, fy, cx, cy), rel=1e-5)
    result = pn.Engine().render(floor(), camera, size=(64, 48))
    seen = numpy.isfinite(result.depth)
    assert 100 < seen.sum() < seen.size
    v, u = numpy.nonzero(seen)
    z = result.depth[seen]
    in_camera = numpy.stack([(u - cx) / fx * z, (v - cy) / fy * z, z, numpy.ones_like(z)])
    numpy.testing.assert_allclose((pose @ in_camera)[:3].T, result.position[seen], atol=2e-5)

    flip = numpy.diag([1.0, -1, -1, 1])
    same = pn.Camera.from_intrinsics((64, 48), fx, fy, cx, cy, pose @ flip, convention="opengl")
    numpy.testing.assert_array_equal(pn.Engine().render(floor(), same, size=(64, 48)).ids, result.ids)


def test_an_animated_scene_moves(scenes):
    still = pn.load_scene(scenes / "cornell.gltf")
    assert still.duration == 0
    mill = pn.load_scene(scenes / "windmill.glb")
    assert mill.duration == 4
    later = mill.at_time(0.5)
    assert (later.triangles == mill.triangles).all()
    assert (later.vertices != mill.vertices).any()
    assert (later.at_time(0).vertices == mill.at_time(0).vertices).all()
    with pytest.raises(pn.Error):
        mill.at_time(float("nan"))


def test_confined_scenes_name_files_below_their_folder_only(tmp_path):
    (tmp_path / "m.mtl").write_text("newmtl m\nKd 1 0 0\n")
    (tmp_path / "scene").mkdir()
    scene = tmp_path / "scene" / "a.obj"
    scene.write_text("mtllib ../m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert len(pn.load_scene(scene).vertices) == 3
    with pytest.raises(pn.Error, match="lies outside the scene's folder"):
        pn.load_scene(scene, confine=True)


def test_the_memory_that_a_file_may_ask_for_is_limited(scenes):
    with pytest.raises(pn.Error, match="load_limit"):
        pn.load_scene(scenes / "windmill.glb", load_limit=1)
    assert pn.load_scene(scenes / "windmill.glb", load_limit=1000).triangles.shape[1] == 3


# OBJ, MTL and paths say no encoding: Latin-1 here.
def test_text_that_is_not_utf8_is_shown(tmp_path):
    (tmp_path / "m.mtl").write_bytes(b"newmtl gr\xfcn\nKd 0 1 0\n")
    (tmp_path / "a.obj").write_bytes(b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl gr\xfcn\nf 1 2 3\nusemtl fehlt_\xfc\nf 1 2 3\n")
    with pytest.warns(UserWarning, match="fehlt_\ufffd"):
        scene = pn.load_scene(tmp_path / "a.obj")
    assert "gr\ufffdn" in [material.name for material in scene.materials]
    assert "gr\ufffdn" in repr([material for material in scene.materials])
    with pytest.raises(pn.Error, match="missing_\ufffd"):
        pn.load_scene(os.fsdecode(bytes(tmp_path) + b"/missing_\xfc.obj"))
