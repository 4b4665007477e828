"""Layers for data sets: ids, motion, coverage, boxes, masks."""
import base64
import json

import numpy
import pinocchio_renderer as pn
import pytest

NOTHING = 0xFFFFFFFF


def square(half, z=0.0, material=None):
    corners = numpy.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], numpy.float32) * half
    corners[:, 2] = z
    faces = numpy.array([[0, 1, 2], [0, 2, 3]], numpy.uint32)
    return pn.Scene(corners, faces, materials=material or pn.Material())


def moved(x, y, z):
    pose = numpy.eye(4)
    pose[:3, 3] = x, y, z
    return pose


@pytest.fixture
def squares():
    """A small square before a large one; a pixel of 100x100 is 0.1 wide at z = 0 and 0.08 at z = 1."""
    scene = pn.assemble({"behind": square(4), "before": (square(1), moved(0, 0, 1))})
    scene.cameras = [pn.Camera(eye=(0, 0, 5), target=(0, 0, 0), fov=90)]
    return scene


def test_ids_name_nodes_materials_and_faces(squares):
    picture = pn.Engine().render(squares, size=(100, 100))
    for name in ("objects", "materials", "primitives"):
        layer = getattr(picture, name)
        assert layer.dtype == numpy.uint32 and layer.shape == (100, 100)
        assert layer[0, 0] == NOTHING
    assert squares.nodes[picture.objects[50, 50]] == "before"
    assert squares.nodes[picture.objects[50, 20]] == "behind"
    hit = picture.ids != NOTHING
    numpy.testing.assert_array_equal(picture.materials[hit], squares.triangle_materials[picture.ids[hit]])
    assert set(numpy.unique(picture.primitives[hit])) == {0, 1}
    many = pn.Engine().render_many(
        squares, [None], (100, 100), outputs=["ids", "objects", "materials", "primitives"]
    )
    for name, layers in many.items():
        numpy.testing.assert_array_equal(layers[0], getattr(picture, name), err_msg=name)


def test_motion_leads_to_the_next_and_the_former_frame(squares):
    engine = pn.Engine()
    now = engine.render(squares, size=(100, 100))
    next_scene = squares.posed({"before": moved(0.4, 0.8, 1)})
    motion = now.motion(scene=next_scene)
    assert motion.shape == (100, 100, 2) and motion.dtype == numpy.float32
    numpy.testing.assert_allclose(motion[50, 50], (5, -10), atol=1e-4)
    numpy.testing.assert_array_equal(motion[50, 20], (0, 0))
    numpy.testing.assert_array_equal(motion[0, 0], (0, 0))
    # Every pixel that moves arrives at a pixel of the same triangle.
    then = engine.render(next_scene, size=(100, 100))
    moving = now.objects == squares.nodes.index("before")
    for y, x in numpy.argwhere(moving & (numpy.arange(100) > 45) & (numpy.arange(100)[:, None] > 55)):
        to = numpy.round((x, y) + motion[y, x]).astype(int)
        assert then.objects[to[1], to[0]] == now.objects[y, x]
    numpy.testing.assert_allclose(then.motion(scene=squares)[40, 55], (-5, 10), atol=1e-4)
    other = pn.Camera(eye=(0.5, 0, 5), target=(0.5, 0, 0), fov=90)
    numpy.testing.assert_allclose(now.motion(camera=other)[50, 20], (-5, 0), atol=1e-4)
    assert not now.motion().any()
    away = pn.Camera(eye=(0, 0, 5), target=(0, 0, 9), fov=90)
    assert numpy.isnan(now.motion(camera=away)[50, 50]).all()
    many = engine.render_many(
        squares, [None, other], (100, 100), outputs=["motion"], motion_scene=next_scene, motion_cameras=[None, other]
    )["motion"]
    numpy.testing.assert_array_equal(many[0], motion)


def test_poses_are_the_pictures_one_by_one(squares):
    squares.lights.append(pn.Light(position=(1, 2, 4)))  # without it, each call adds a light that suits the scene
    engine, size = pn.Engine(), (60, 40)
    poses = [{"before": moved(x, 0.8, 1)} for x in (0.0, 0.4, 0.8)]
    poses.insert(1, poses[0])
    outputs = ["color", "depth", "ids", "motion"]
    arrays = engine.render_many(squares, [None], size, poses=poses, outputs=outputs)
    for i, pose in enumerate(poses):
        now = squares.posed(pose)
        one = engine.render(now, size=size)
        for name in outputs[:3]:
            numpy.testing.assert_array_equal(arrays[name][i], getattr(one, name), err_msg=name)
        numpy.testing.assert_array_equal(arrays["motion"][i], one.motion(scene=squares.posed(poses[min(i + 1, 3)])))
    assert arrays["motion"][1].any() and not arrays["motion"][0].any()
    other = pn.Camera(eye=(0.5, 0, 5), target=(0.5, 0, 0), fov=90)
    two = engine.render_many(squares, [None, other], size, poses=poses[2:])
    numpy.testing.assert_array_equal(two["color"][1], engine.render(squares.posed(poses[3]), other, size=size).color)


def test_a_camera_of_the_scene_moves_with_its_node(scenes):
    scene = pn.load_scene(scenes / "windmill.glb")
    node = scene.nodes.index("main")
    pose = scene.node_transforms[node].copy()
    pose[1, 3] += 1.0
    depth = pn.Engine().render_many(scene, [0], (30, 20), outputs=["depth"], poses=[{node: pose}])["depth"][0]
    numpy.testing.assert_array_equal(depth, pn.Engine().render(scene.posed({node: pose}), size=(30, 20)).depth)
    assert (depth != pn.Engine().render(scene, size=(30, 20)).depth).any()


def test_of_two_equal_cameras_the_chosen_one_moves_with_its_node(tmp_path):
    corners = numpy.array([[-1, -1, -4], [1, -1, -4], [0, 1, -4]], "float32").tobytes()
    attributes = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, -4], "max": [1, 1, -4]}
    gltf = {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": "data:;base64," + base64.b64encode(corners).decode(), "byteLength": len(corners)}],
        "bufferViews": [{"buffer": 0, "byteLength": len(corners)}],
        "accessors": [attributes],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "cameras": [{"name": "eye", "type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "nodes": [{"mesh": 0}, {"name": "left", "camera": 0}, {"name": "right", "camera": 0}],
        "scenes": [{"nodes": [0, 1, 2]}],
    }
    (tmp_path / "two.gltf").write_text(json.dumps(gltf))
    scene = pn.load_scene(tmp_path / "two.gltf")
    pose = {"right": moved(0.5, 0, 0)}
    still, moving = pn.Engine().render_many(scene, [0, 1], (30, 20), outputs=["depth"], poses=[pose, pose])["depth"]
    numpy.testing.assert_array_equal(still, pn.Engine().render(scene, size=(30, 20)).depth)
    assert (still != moving).any()


def test_poses_that_cannot_be_are_refused(squares):
    draw = lambda *cameras, **more: pn.Engine().render_many(squares, cameras, (20, 20), outputs=["motion"], **more)
    with pytest.raises(pn.Error, match="3 poses and 2 cameras; give a camera for each pose, or one for all"):
        draw(None, None, poses=[{}, {}, {}])
    with pytest.raises(pn.Error, match="leave out motion_scene"):
        draw(None, poses=[{}], motion_scene=squares)
    with pytest.raises(pn.Error, match="no node 'roof'"):
        draw(None, poses=[{}, {"roof": numpy.eye(4)}])
    assert draw(None, poses=[])["motion"].shape == (0, 20, 20, 2)


def test_motion_of_another_scene_is_refused(squares):
    picture = pn.Engine().render(squares, size=(20, 20))
    with pytest.raises(pn.Error, match="2 triangles, this one 4; motion is between two poses"):
        picture.motion(scene=square(1))
    with pytest.raises(pn.Error, match="1 motion_cameras and 2 cameras"):
        pn.Engine().render_many(squares, [None, None], (20, 20), outputs=["motion"], motion_cameras=[None])


def test_exr_has_the_layers_that_are_asked_for(squares, tmp_path):
    picture = pn.Engine().render(squares, size=(100, 100))
    picture.write_exr(tmp_path / "usual.exr")
    usual = pn.read_exr(tmp_path / "usual.exr")
    assert not {"id.node", "id.material", "id.primitive", "motion.X"} & set(usual)
    next_scene = squares.posed({"before": moved(0.4, 0.8, 1)})
    picture.write_exr(tmp_path / "all.exr", aov="all,id.node,id.material,id.primitive,motion", motion_scene=next_scene)
    channels = pn.read_exr(tmp_path / "all.exr")
    assert set(channels) > set(usual)
    numpy.testing.assert_array_equal(channels["id.node"], picture.objects)
    numpy.testing.assert_array_equal(channels["id.material"], picture.materials)
    numpy.testing.assert_array_equal(channels["id.primitive"], picture.primitives)
    numpy.testing.assert_array_equal(channels["motion.X"], picture.motion(scene=next_scene)[..., 0])


def test_boxes_are_tight():
    ids = numpy.full((6, 8), NOTHING, numpy.uint32)
    ids[1:3, 2:5] = 7
    ids[4, 7] = 0
    assert pn.boxes(ids) == {7: (2, 1, 5, 3), 0: (7, 4, 8, 5)}
    assert pn.boxes(numpy.full((2, 2), NOTHING, numpy.uint32)) == {}
    with pytest.raises(pn.Error, match="of one picture"):
        pn.boxes(numpy.zeros((2, 3, 4), numpy.uint32))


def test_masks_see_through_what_is_before(squares):
    engine = pn.Engine()
    masks = pn.amodal_masks(engine, squares, size=(100, 100))
    assert set(masks) == {"behind", "before"}
    assert masks["behind"].sum() == 80 * 80  # as if nothing were before it
    assert masks["before"].sum() == pytest.approx(25 * 25, abs=60)
    share = pn.visible_share(engine, squares, size=(100, 100))
    assert share["before"] == 1.0
    seen = masks["behind"] & ~masks["before"]
    assert share["behind"] == pytest.approx(seen.sum() / masks["behind"].sum(), abs=1e-9)
    box = pn.boxes(engine.render(squares, size=(100, 100)).objects)[squares.nodes.index("before")]
    rows, columns = numpy.nonzero(masks["before"])
    assert box == (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)


def test_masks_of_what_is_not_there(squares):
    away = pn.Camera(eye=(0, 0, 5), target=(0, 0, 9))
    assert pn.visible_share(pn.Engine(), squares, ["before"], away, (20, 20)) == {"before": 0.0}
    with pytest.raises(pn.Error, match="no node 'nowhere'"):
        pn.amodal_masks(pn.Engine(), squares, ["nowhere"], size=(20, 20))


def test_a_node_with_its_children_alone(scenes):
    scene = pn.load_scene(scenes / "windmill.glb")
    parts = [scene.only([name]) for name in scene.nodes]
    drawn = [p for p in parts if p is not None]
    assert drawn and max(len(p.triangles) for p in drawn) <= len(scene.triangles)
    assert len(scene.only(list(scene.nodes)).triangles) == len(scene.triangles)
    with pytest.raises(pn.Error, match="no node 'nowhere'"):
        scene.only(["nowhere"])
    with pytest.raises(pn.Error, match="there is no node 9999"):
        scene.only([9999])


def test_alpha_counts_what_blends_when_asked(scenes):
    scene = pn.load_scene(scenes / "terrace.glb")
    engine = pn.Engine()
    plain = engine.render(scene, size=(80, 60))
    covered = engine.render(scene, size=(80, 60), coverage=True)
    assert set(numpy.unique(plain.color[..., 3])) <= {0.0, 1.0}
    assert (covered.color[..., 3] <= plain.color[..., 3]).all()
    numpy.testing.assert_allclose(covered.color[..., :3], plain.color[..., :3], atol=1e-5)
