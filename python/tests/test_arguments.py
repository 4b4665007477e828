"""What a wrong argument gets: one line that names it and says what it should be."""
import collections.abc
import types

import numpy
import pinocchio_renderer as pn
import pytest

from test_tracer import quad

VERTICES, TRIANGLES = quad()
NAN_POSE = numpy.eye(4)
NAN_POSE[1, 3] = numpy.nan
MIRROR = numpy.diag([-1.0, 1, 1, 1])
SHEAR = numpy.eye(4)
SHEAR[0, 1] = 0.5


def node_scene():
    return pn.assemble({"part": pn.Scene(VERTICES, TRIANGLES)})


@pytest.mark.parametrize(
    "call, says",
    [
        (lambda: pn.Scene(VERTICES[:, :2], TRIANGLES), r"vertices has the shape \(4, 2\); it is an array \(n, 3\)"),
        (lambda: pn.Scene(3, TRIANGLES), "vertices is one number; it is an array"),
        (lambda: pn.Scene([[1, 2, 3], [4, 5]], TRIANGLES), "vertices cannot be converted to an array"),
        (lambda: pn.Scene({1: 2}, TRIANGLES), "vertices is of the type object"),
        (lambda: pn.Scene([["1", "2", "3"]] * 4, TRIANGLES), "vertices is of the type <U1"),
        (lambda: pn.Scene(VERTICES, [[0, 1, 1.5]]), "triangles holds 1.5; it is an array of whole numbers"),
        (lambda: pn.Scene(VERTICES, [[0, 1, -1]]), "triangles holds -1;"),
        (lambda: pn.Scene(VERTICES, [[0, 1, numpy.nan]]), "triangles holds nan;"),
        (lambda: pn.Scene(VERTICES, [["0", "1", "2"]]), "triangles is of the type <U1"),
        (lambda: pn.Scene(VERTICES, TRIANGLES == 1), "triangles is of the type bool"),
        (lambda: pn.Scene(VERTICES, TRIANGLES, uvs=VERTICES), r"uvs has the shape \(4, 3\); it is an array \(n, 2\)"),
        (lambda: pn.Scene(VERTICES, TRIANGLES, normals=VERTICES[1:]), "normals has 3 rows; it needs one for each vertex"),
        (lambda: pn.Scene(VERTICES, TRIANGLES, ambient=(1, 1)), r"ambient has the shape \(2,\); it is an array \(3,\)"),
        (lambda: pn.Scene(VERTICES, TRIANGLES, lights=["sun"]), r"lights\[0\] is a str; it must be a Light"),
        (lambda: pn.Scene(VERTICES * numpy.nan, TRIANGLES), "vertices holds nan in row 0; it needs finite numbers"),
        (lambda: pn.Scene(VERTICES, TRIANGLES, normals=numpy.full((4, 3), numpy.inf)), "normals holds inf in row 0; it needs finite numbers"),
        (lambda: pn.Scene(VERTICES, TRIANGLES, colors=[[0, numpy.nan, 0]] * 2), "colors holds nan; it needs finite numbers"),
        (lambda: pn.Scene(VERTICES, TRIANGLES, colors=[[0.5, -1, 0]] * 4), "colors holds -1.0; it needs finite numbers from 0 on"),
        (lambda: pn.Scene(VERTICES, TRIANGLES, colors=[[0, 200, 0]] * 4), "colors holds whole numbers above 1; it is linear"),
        (
            lambda: pn.Scene(VERTICES, TRIANGLES, colors=numpy.ones((2, 3)), triangle_materials=[0, 77]),
            "triangle_materials holds 77; there are 1 materials",
        ),
        (lambda: pn.Material(diffuse="red"), "diffuse is of the type <U3"),
        (lambda: pn.Material(diffuse=(0, -1, 0)), r"diffuse is \(0, -1, 0\); it needs numbers from 0 on"),
        (lambda: pn.Material(ior=0), "ior is 0.0; it is a finite number, 0.001 or more"),
        (lambda: pn.Material(shininess=numpy.nan), "shininess is nan; it is a finite number"),
        (lambda: pn.Light((0, 0, 1), color=(-5, 0, 0)), r"color is \(-5, 0, 0\); it needs numbers from 0 on"),
        (lambda: pn.Light((0, 0, 1), range=-1), "range is -1.0; it is above 0"),
        (lambda: pn.Light((0, 0, 1), range=numpy.nan), "range is nan; it is above 0"),
        (lambda: pn.Light((0, 0, 1), (0, 0, -1), outer_cone=numpy.nan), "outer_cone is nan; it is a finite number"),
        (lambda: pn.Light((0, 0, 1), (0, 0, -1), inner_cone=50), "inner_cone is 50.0; .*at most 45"),
        (lambda: node_scene().posed({(1, 2): numpy.eye(4)}), r"transforms names \(1, 2\); give a node's name or index"),
        (lambda: node_scene().posed([numpy.eye(4)]), "transforms is a list; it is a dict"),
        (
            lambda: node_scene().posed({"part": numpy.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [5, 0, 0, 1.0]])}),
            r"the transform of 'part' has the last row \[5. 0. 0. 1.\]; it is \(0, 0, 0, 1\)",
        ),
        (lambda: pn.assemble({1: pn.Scene(VERTICES, TRIANGLES)}), "a part is named 1; its name is a text"),
        (lambda: pn.from_trimesh([1, 2]), "a list has no triangles; give a trimesh.Trimesh"),
        (lambda: pn.boxes(numpy.full((2, 2), numpy.nan)), "ids is of the type float64; give whole numbers"),
        (lambda: pn.compare(numpy.zeros((4, 4)), numpy.zeros((4, 4))), r"a picture has the shape \(4, 4\)"),
        (lambda: pn.compare(numpy.zeros((4, 4, 3), int), numpy.zeros((4, 4, 3))), "a picture has the type int64; it needs"),
        (
            lambda: pn.Engine().render(node_scene(), size=(4, 4), background=("a", "b", "c")),
            r"background is \('a', 'b', 'c'\); it is",
        ),
        (lambda: pn.Material(texture=numpy.zeros((2, 2), numpy.uint8)), r"texture has the shape \(2, 2\)"),
        (lambda: pn.Material(texture=numpy.full((2, 2, 3), 0.5)), "texture holds 0.5; .*from 0 to 255"),
        (lambda: pn.Light(position=(0, 0)), r"position has the shape \(2,\)"),
        (lambda: pn.Light(direction=(0, 0, 0)), "direction must not be zero"),
        (lambda: pn.Light(position=(0, 0, numpy.inf)), "position holds inf; it needs finite numbers"),
        (lambda: pn.Light(position=(0, 0, 1), intensity=numpy.nan), "intensity is nan; it is a finite number, 0.0 or more"),
        (lambda: pn.Light(direction=(0, 0, 1), angle=200), "angle is 200.0; it is a finite number, 0.0 or more and at most 180"),
        (lambda: pn.Camera("here", (0, 0, 0)), "eye is of the type <U4"),
        (lambda: pn.Camera((0, numpy.nan, 5), (0, 0, 0)), "eye holds nan; it needs finite numbers"),
        (lambda: pn.Camera.from_pose(NAN_POSE), "pose holds nan; it needs finite numbers"),
        (lambda: pn.Camera.from_pose(numpy.eye(3)), r"pose has the shape \(3, 3\); it is an array \(4, 4\)"),
        (lambda: pn.Camera.from_pose(numpy.diag([2.0, 2, 2, 1])), "pose scales: its column 0 has the length 2"),
        (lambda: pn.Camera.from_pose(MIRROR), "pose mirrors"),
        (lambda: pn.Camera.from_pose(SHEAR), "pose (shears|scales)"),
        (lambda: pn.Camera.from_intrinsics((64, 48), 50, 50, 32, 24, numpy.diag([0.5, 0.5, 0.5, 1])), "pose scales"),
        (lambda: pn.Camera.from_intrinsics((64, 48), 50, 50, numpy.nan, 24), "must be finite"),
        (lambda: pn.Camera.from_intrinsics((64.5, 48), 50, 50, 32, 24), "size holds 64.5"),
        (lambda: node_scene().posed({"part": NAN_POSE}), "the transform of 'part' holds nan"),
        (lambda: node_scene().posed({"part": numpy.eye(3)}), r"the transform of 'part' has the shape \(3, 3\)"),
        (lambda: pn.assemble({"a": "scene"}), "the part 'a' must be a scene, or"),
        (lambda: pn.assemble({"a": (node_scene(), numpy.eye(3))}), r"the matrix of 'a' has the shape \(3, 3\)"),
        (lambda: pn.Tracer(VERTICES, [[0, 1, 2.5]]), "triangles holds 2.5"),
        (lambda: pn.Tracer(VERTICES, TRIANGLES).closest_hits([0, 0, 1], [[0, 0, 1]]), r"origins has the shape \(3,\)"),
        (lambda: pn.Engine().render(node_scene(), size=(8, 8.5)), "size holds 8.5"),
        (lambda: pn.Engine().render(node_scene(), size=(8, 8, 8)), r"size has the shape \(3,\)"),
        (lambda: pn.Engine().render(node_scene(), spp="4"), "spp is '4'; it is a whole number from 1"),
        (lambda: pn.Engine().render(node_scene(), spp=1.5), "spp is 1.5; it is a whole number from 1"),
        (lambda: pn.Engine().render(node_scene(), spp=True), "spp is True; it is a whole number"),
        (lambda: pn.Engine().render(node_scene(), filter_textures=1), "filter_textures is 1; it is True or False"),
    ],
)
def test_a_wrong_argument_is_named(call, says):
    with pytest.raises(pn.Error, match=says) as caught:
        call()
    assert "incompatible function arguments" not in str(caught.value) and "\n" not in str(caught.value)


def test_compare_takes_arrays_of_any_layout_and_float_type():
    picture = numpy.linspace(0, 1, 4 * 4 * 3).reshape(4, 4, 3)
    for same in (picture.astype(">f4"), numpy.broadcast_to(picture, (4, 4, 3)), picture.tolist(), picture.astype("f2")):
        assert pn.compare(picture.astype("f4"), same)["max"] < 1e-3
    shown = (picture * 255).astype(numpy.uint8)
    shown.flags.writeable = False
    assert pn.compare(shown, shown)["rmse"] == 0


def test_a_last_row_may_be_rounded():
    rounded = numpy.eye(4)
    rounded[3] = 1e-7, 0, -1e-17, 0.99999994
    assert node_scene().posed({"part": rounded}).node_transforms[0][3].tolist() == [0, 0, 0, 1]
    assert pn.Camera.from_pose(rounded).fov == 45


def test_a_mapping_that_fails_says_why():
    class Broken(collections.abc.Mapping):
        def __getitem__(self, key):
            raise KeyError(key)

        def __iter__(self):
            raise RuntimeError("nothing to see")

        def __len__(self):
            return 1

    with pytest.raises(RuntimeError, match="nothing to see"):
        node_scene().posed(Broken())


def test_glass_without_a_distance_is_clear():
    assert pn.Material(attenuation_distance=numpy.inf).attenuation_distance == 0


def test_large_material_numbers_are_kept():
    large = pn.Material(attenuation_distance=5e6, shininess=2e6)
    assert (large.attenuation_distance, large.shininess) == (5e6, 2e6)


def test_a_background_may_be_arrays_without_axes():
    grey = tuple(numpy.array(0.5, numpy.float32) for _ in range(3))
    picture = pn.Engine().render(node_scene(), pn.Camera((0, 0, 4), (0, 0, 8)), (4, 4), background=grey)
    assert (picture.color[..., :3] == 0.5).all()


def test_a_generator_of_lights_is_read_once():
    scene = pn.Scene(VERTICES, TRIANGLES)
    scene.lights = (pn.Light((0, 0, z)) for z in (1, 2))
    scene.cameras = map(lambda z: pn.Camera((0, 0, z), (0, 0, 0)), (3, 4))
    assert len(scene.lights) == len(scene.cameras) == 2


def test_mappings_are_taken_as_dicts():
    moved = types.MappingProxyType({"part": numpy.diag([2.0, 2, 2, 1])})
    scene = node_scene()
    assert scene.posed(moved).bounds[1][0] == 2 * scene.bounds[1][0]
    camera = pn.Camera((0, 0, 4), (0, 0, 0))
    pictures = pn.Engine().render_many(scene, [camera], (8, 8), poses=[moved, moved])
    again = pn.Engine().render_many(scene, [camera], (8, 8), poses=[moved, moved], out=types.MappingProxyType(pictures))
    assert again["color"] is pictures["color"]


def test_one_length_for_all_rays_may_be_an_array_without_axes():
    tracer = pn.Tracer(VERTICES, TRIANGLES)
    assert [tracer.occluded([[0.2, 0.1, 1]], [[0, 0, -1]], numpy.array(t))[0] for t in (0.5, 2.0)] == [False, True]


def test_a_scene_without_nodes_has_no_part_alone():
    assert pn.Scene(VERTICES, TRIANGLES).only([]) is None


def test_colours_of_vertices_and_triangles_are_as_bright_and_keep_materials():
    camera, engine = pn.Camera((0, 0, 4), (0, 0, 0)), pn.Engine()
    by_vertex = engine.render(pn.Scene(VERTICES, TRIANGLES, colors=numpy.full((4, 3), 0.5)), camera, (8, 8))
    by_triangle = engine.render(pn.Scene(VERTICES, TRIANGLES, colors=numpy.full((2, 3), 0.5)), camera, (8, 8))
    assert by_vertex.albedo[4, 4, 0] == by_triangle.albedo[4, 4, 0] == 0.5
    materials = [pn.Material(), pn.Material(diffuse=(0.5, 0.5, 0.5), emission=(5, 0, 0))]
    lit = pn.Scene(VERTICES, TRIANGLES, colors=[[0, 1, 0], [1, 1, 0]], materials=materials, triangle_materials=[0, 1])
    assert [m.emission for m in lit.materials] == [(0, 0, 0), (5, 0, 0)]
    assert lit.materials[1].diffuse == (0.5, 0.5, 0)


def test_a_spot_light_tells_its_cones():
    spot = pn.Light((0, 0, 1), (0, 0, -1), inner_cone=10, outer_cone=20)
    assert (spot.inner_cone, spot.outer_cone) == (pytest.approx(10, abs=1e-3), pytest.approx(20, abs=1e-3))


def test_the_variable_of_threads_is_checked(monkeypatch):
    for wrong in ("abc", "-3", "2x", "5000"):
        monkeypatch.setenv("PINOCCHIO_THREADS", wrong)
        with pytest.raises(pn.Error, match=f"PINOCCHIO_THREADS is '{wrong}'; it is a number from 0"):
            pn.Engine()
        assert pn.Engine(threads=1).threads == 1
    monkeypatch.setenv("PINOCCHIO_THREADS", "")
    pn.Engine()


def test_what_numpy_can_convert_is_taken():
    scene = pn.Scene(VERTICES.tolist(), TRIANGLES.astype(numpy.float64), lights=(pn.Light([0, 0, 3]),))
    numpy.testing.assert_array_equal(scene.triangles, TRIANGLES)
    camera = pn.Camera(numpy.array([0, 0, 4]), numpy.zeros(3), up=[0, 1, 0])
    camera.target = numpy.float64([0.5, 0, 0])
    assert camera.target == (0.5, 0, 0)
    with pytest.raises(pn.Error, match=r"target has the shape \(2,\)"):
        camera.target = (0, 0)
    settings = dict(spp=numpy.int64(2), max_noise=numpy.float32(0.5), filter_textures=numpy.True_)
    assert pn.Engine().render(scene, camera, size=numpy.array([8, 6]), **settings).color.shape == (6, 8, 4)
    # A rotation in few digits is one.
    pose = numpy.eye(4)
    pose[:2, :2] = [[0.8660, -0.5], [0.5, 0.8660]]
    pn.Camera.from_pose(pose)


@pytest.mark.parametrize("word, new", [("depth", "bounces"), ("normals", "send_normals"), ("reflection", "reflection_format")])
def test_a_setting_has_no_arrays_name(word, new):
    scene = pn.Scene(VERTICES, TRIANGLES)
    with pytest.raises(pn.Error, match=f"the setting .* is '{new}'"):
        pn.Engine().render(scene, **{word: 1})
    assert f"\n{new}: " in pn.Engine.render.__doc__ and f"\n{word}: " not in pn.Engine.render.__doc__


def test_bounces_are_the_programs_depth():
    mirror = pn.Material(diffuse=(0, 0, 0), reflectance=(1, 1, 1))
    scene = pn.Scene(VERTICES, TRIANGLES, materials=mirror)
    rays = [pn.Engine().render(scene, size=(8, 8), bounces=n).record["rays"].get("reflection", 0) for n in (0, 1)]
    assert rays[0] == 0 and rays[1] > 0


def test_help_begins_with_what_changes_the_picture():
    text = pn.Engine.render.__doc__
    first = [text.index(f"\n{name}: ") for name in ("spp", "bounces", "backfaces")]
    last = [text.index(f"\n{name}: ") for name in ("id_bits", "reflection_format", "visibility", "mask_bits")]
    assert max(first) < min(last)
    assert text.index("\nspp: ") < text.index("\nbounces: ")


@pytest.mark.parametrize("make, name, wrong", [
    (lambda: pn.Camera((0, 0, 4), (0, 0, 0)), "fov", (0, 180, -1, numpy.nan)),
    (lambda: pn.Camera((0, 0, 4), (0, 0, 0)), "lens_radius", (-1, numpy.inf)),
    (lambda: pn.Light(position=(0, 0, 4)), "intensity", (-1, numpy.nan)),
    (lambda: pn.Light(position=(0, 0, 4)), "radius", (-1, numpy.inf)),
])
def test_a_property_takes_what_the_constructor_takes(make, name, wrong):
    value = make()
    setattr(value, name, 2.5)
    assert getattr(value, name) == 2.5
    for number in wrong:
        with pytest.raises(pn.Error, match=f"{name} is {float(number)}; it is a finite number"):
            setattr(value, name, number)
    assert getattr(value, name) == 2.5
