"""Cameras beside the pinhole, and rays that the caller gives."""
import copy
import pickle

import numpy
import pinocchio_renderer as pn
import pytest

SIZE = (80, 60)
CV = [0.1, -0.05, 0.002, -0.003, 0.01, 0.05, 0.02, 0.001]
AT = {"eye": (0.3, 1.0, 5.0), "target": (0.0, 0.4, 0.0)}


def cameras():
    pose = numpy.eye(4)
    pose[:3, 3] = 0.1, 1.0, -4.0
    pose[:3, :3] = [[1, 0, 0], [0, -1, 0], [0, 0, -1]]
    pose[2, 3] = 5.0
    return {
        "orthographic": pn.Camera.orthographic(**AT, height=3.0),
        "panorama": pn.Camera.panorama(**AT),
        "fisheye": pn.Camera.fisheye(**AT, fov=200, distortion=[0.02, -0.003, 0.0004, 0.0]),
        "lens": pn.Camera.from_intrinsics(SIZE, 70, 72, 38, 31, pose, distortion=CV),
        "fisheye lens": pn.Camera.from_intrinsics(
            SIZE, 30, 31, 38, 31, pose, distortion=[0.02, -0.003, 0.0004, 0.0], projection="fisheye"
        ),
    }


@pytest.mark.parametrize("name", cameras())
def test_points_of_a_picture_project_to_their_pixels(scenes, name):
    camera = cameras()[name]
    picture = pn.Engine().render(pn.load_scene(scenes / "two-lights.gltf"), camera, SIZE)
    seen = picture.ids != 0xFFFFFFFF
    assert seen.sum() > 100
    y, x = numpy.nonzero(seen)
    at = camera.project(picture.position[seen], SIZE)
    numpy.testing.assert_allclose(at, numpy.stack([x, y], -1), atol=2e-3)


def test_opencv_agrees_about_lenses():
    cv2 = pytest.importorskip("cv2")
    made = cameras()
    rng = numpy.random.default_rng(1)
    camera_points = rng.uniform((-1, -1, 1.5), (1, 1, 4), (200, 3))
    pose = numpy.array([[1, 0, 0, 0.1], [0, -1, 0, 1.0], [0, 0, -1, 5.0], [0, 0, 0, 1]])
    world = (camera_points @ pose[:3, :3].T + pose[:3, 3]).astype(numpy.float32)
    k = numpy.array([[70, 0, 38], [0, 72, 31], [0, 0, 1.0]])
    expected, _ = cv2.projectPoints(camera_points, numpy.zeros(3), numpy.zeros(3), k, numpy.array(CV))
    numpy.testing.assert_allclose(made["lens"].project(world, SIZE), expected[:, 0], atol=1e-3)
    k = numpy.array([[30, 0, 38], [0, 31, 31], [0, 0, 1.0]])
    expected, _ = cv2.fisheye.projectPoints(
        camera_points[:, None], numpy.zeros((1, 3)), numpy.zeros((1, 3)), k, numpy.array([0.02, -0.003, 0.0004, 0.0])
    )
    numpy.testing.assert_allclose(made["fisheye lens"].project(world, SIZE), expected[:, 0], atol=1e-3)


def test_a_stereo_pair_has_the_disparity_of_its_baseline(scenes):
    scene = pn.load_scene(scenes / "two-lights.gltf")
    left = pn.Camera(eye=(0, 1, 5), target=(0, 1, 0), fov=50)
    right = pn.Camera(eye=(0.1, 1, 5), target=(0.1, 1, 0), fov=50)
    picture = pn.Engine().render(scene, left, SIZE)
    seen = picture.ids != 0xFFFFFFFF
    fx = left.intrinsics(SIZE)[0]
    numpy.testing.assert_allclose(picture.motion(camera=right)[seen][:, 0], -0.1 * fx / picture.depth[seen], atol=1e-3)


@pytest.mark.parametrize("name", cameras())
def test_cameras_copy_pickle_and_show_themselves(name):
    camera = cameras()[name]
    for other in (copy.copy(camera), copy.deepcopy(camera), pickle.loads(pickle.dumps(camera))):
        assert repr(other) == repr(camera)
        assert (other.projection, other.distortion, other.height) == (camera.projection, camera.distortion, camera.height)
    assert camera.projection in repr(camera) or camera.projection == "perspective"


def test_a_camera_that_became_wrong_is_refused(scenes):
    scene, camera = pn.load_scene(scenes / "cornell.gltf"), pn.Camera(**AT)
    camera.target = camera.eye
    with pytest.raises(pn.Error, match="the camera's eye and its target are the same point; move one of them"):
        pn.Engine().render(scene, camera, (8, 8))
    with pytest.raises(pn.Error, match="same point"):
        pn.Engine().render_many(scene, [scene.cameras[0], camera], (8, 8), outputs=["color"])


def test_wrong_cameras_are_refused():
    with pytest.raises(pn.Error, match="height is 0.0"):
        pn.Camera.orthographic(**AT, height=0)
    with pytest.raises(pn.Error, match="fov is 361.0"):
        pn.Camera.fisheye(**AT, fov=361)
    with pytest.raises(pn.Error, match="distortion has 3 numbers; a fisheye has 4"):
        pn.Camera.fisheye(**AT, distortion=[1, 2, 3])
    with pytest.raises(pn.Error, match="distortion has 6 numbers; there are 4, 5 or 8"):
        pn.Camera.from_intrinsics(SIZE, 70, 70, 40, 30, distortion=[0] * 6)
    with pytest.raises(pn.Error, match="projection is 'wide'"):
        pn.Camera.from_intrinsics(SIZE, 70, 70, 40, 30, projection="wide")
    with pytest.raises(pn.Error, match="only perspective and fisheye cameras can have a distortion"):
        pn.Camera.panorama(**AT).distortion = [0.1, 0, 0, 0]


def test_a_picture_of_given_rays_is_shaded_as_any_other(scenes):
    scene = pn.load_scene(scenes / "two-lights.gltf")
    camera = cameras()["orthographic"]
    picture = pn.Engine().render(scene, camera, SIZE)
    y, x = numpy.indices(SIZE[::-1])
    forward = numpy.subtract(AT["target"], AT["eye"])
    forward /= numpy.linalg.norm(forward)
    right = numpy.cross(forward, (0, 1, 0))
    right /= numpy.linalg.norm(right)
    up = numpy.cross(right, forward)
    step = 3.0 / SIZE[1]
    origins = (
        numpy.array(AT["eye"])
        + (x[..., None] + 0.5 - SIZE[0] / 2) * step * right
        - (y[..., None] + 0.5 - SIZE[1] / 2) * step * up
    )
    given = pn.Engine().render(scene, rays=(origins, numpy.broadcast_to(forward, origins.shape)))
    assert given.color.shape == picture.color.shape
    assert (given.ids != picture.ids).sum() <= 5
    same = given.ids == picture.ids
    assert numpy.quantile(numpy.abs(given.color - picture.color)[same], 0.99) < 1e-3
    hit = same & (picture.ids != 0xFFFFFFFF)
    numpy.testing.assert_allclose(given.depth[hit], picture.depth[hit], rtol=1e-4)


def test_a_lidars_beams_in_one_row(scenes):
    scene = pn.load_scene(scenes / "two-lights.gltf")
    turn, height = numpy.meshgrid(numpy.linspace(0, 2 * numpy.pi, 90, False), numpy.linspace(-0.4, 0.2, 16))
    beams = numpy.stack([numpy.cos(height) * numpy.sin(turn), numpy.sin(height), numpy.cos(height) * numpy.cos(turn)], -1)
    beams = beams.reshape(-1, 3).astype(numpy.float32)
    scan = pn.Engine().render(scene, rays=((0, 1, 4), beams))
    assert scan.depth.shape == (1, 90 * 16)
    hits = pn.Tracer(scene).closest_hits([(0, 1, 4)], beams)
    numpy.testing.assert_array_equal(scan.ids[0], hits.triangle)
    numpy.testing.assert_allclose(scan.depth[0], hits.distance, rtol=1e-5)
    numpy.testing.assert_array_equal(scan.objects[0], hits.node)


def test_wrong_rays_are_refused(scenes):
    scene = pn.load_scene(scenes / "two-lights.gltf")
    engine = pn.Engine()
    for rays in ((1, 2), numpy.zeros(3), (numpy.zeros((4, 3)), numpy.zeros((4, 2))), (numpy.zeros(3),)):
        with pytest.raises(pn.Error, match="rays"):
            engine.render(scene, rays=rays)
    with pytest.raises(pn.Error, match="do not have the shape of their directions"):
        engine.render(scene, rays=(numpy.zeros((4, 3)), numpy.zeros((5, 3))))
    broken = engine.render(scene, rays=(numpy.zeros((2, 3)), [[0, 0, 0], [0, numpy.nan, 1]]))
    assert (broken.ids == 0xFFFFFFFF).all()


def test_stereo_cameras_have_the_disparity_of_their_baseline(scenes):
    scene = pn.load_scene(scenes / "two-lights.gltf")
    middle = pn.Camera(eye=(0.3, 1, 5), target=(0, 0.4, 0), fov=50)
    left, right = middle.stereo(0.12)
    assert numpy.linalg.norm(numpy.subtract(right.eye, left.eye)) == pytest.approx(0.12, rel=1e-5)
    picture = pn.Engine().render(scene, left, SIZE)
    seen = picture.ids != 0xFFFFFFFF
    motion = picture.motion(camera=right)[seen]
    fx = left.intrinsics(SIZE)[0]
    numpy.testing.assert_allclose(-motion[:, 0], fx * 0.12 / picture.depth[seen], rtol=1e-3, atol=1e-3)
    numpy.testing.assert_allclose(motion[:, 1], 0, atol=1e-3)
    with pytest.raises(pn.Error, match="baseline"):
        middle.stereo(float("nan"))


def test_points_and_lines_are_drawn_by_their_diameters(tmp_path):
    file = tmp_path / "cloud.ply"
    file.write_text(
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n0 0 0 255 0 0\n1 0 0 0 0 255\n"
    )
    with pytest.raises(pn.Error, match="only points; draw them with --point-size D"):
        pn.load_scene(file)
    with pytest.raises(pn.Error, match="point_size is a diameter"):
        pn.load_scene(file, point_size=-1)
    scene = pn.load_scene(file, point_size=0.5)
    camera = pn.Camera.orthographic(eye=(0.5, 0, 3), target=(0.5, 0, 0), height=1)
    scene.lights.append(pn.Light(position=(0.5, 0, 30)))
    picture = pn.Engine().render(scene, camera, (200, 100), mode="raytrace")
    seen = picture.ids != 0xFFFFFFFF
    assert seen.sum() == pytest.approx(2 * numpy.pi * 25**2, rel=0.01)  # pixels of two discs
    red, blue = picture.color[seen & (picture.position[..., 0] < 0.5)], picture.color[picture.position[..., 0] > 0.6]
    assert red[:, 0].mean() > 10 * red[:, 2].mean() and blue[:, 2].mean() > 10 * blue[:, 0].mean()
    wire = tmp_path / "wire.obj"
    wire.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n")
    assert len(pn.load_scene(wire, line_width=0.1).triangles) == 2 * 1024


def test_variants_of_materials(tmp_path):
    import json
    import struct

    gltf = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": 36, "uri": "three.bin"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "materials": [{"name": "plain"}, {"name": "painted"}],
        "meshes": [
            {
                "primitives": [
                    {
                        "attributes": {"POSITION": 0},
                        "material": 0,
                        "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]}]}},
                    }
                ]
            }
        ],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "night"}]}},
        "extensionsUsed": ["KHR_materials_variants"],
    }
    (tmp_path / "three.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
    file = tmp_path / "three.gltf"
    file.write_text(json.dumps(gltf))
    scene = pn.load_scene(file)
    assert scene.variants == ["night"] and pickle.loads(pickle.dumps(scene)).variants == ["night"]
    assert scene.materials[int(scene.triangle_materials[0])].name == "plain"
    night = pn.load_scene(file, variant="night")
    assert night.materials[int(night.triangle_materials[0])].name == "painted"
    with pytest.raises(pn.Error, match="choose from 'night'"):
        pn.load_scene(file, variant="noon")


def test_stl_and_the_axis_that_points_up(tmp_path):
    file = tmp_path / "part.stl"
    file.write_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 3\nendloop\nendfacet\n")
    assert pn.load_scene(file).vertices[2].tolist() == [0, 2, 3]
    assert pn.load_scene(file, up_axis="z").vertices[2].tolist() == [0, 3, -2]
    with pytest.raises(pn.Error, match="up_axis is 'x'"):
        pn.load_scene(file, up_axis="x")
    with pytest.raises(pn.Error, match="has no animation 'walk'"):
        pn.load_scene(file, animation="walk")


def test_mitsubas_rays_are_seen_where_they_come_from():
    """Of its cameras, those that we have: perspective and orthographic."""
    mitsuba = pytest.importorskip("mitsuba")
    mitsuba.set_variant("scalar_rgb")
    at = mitsuba.ScalarTransform4f().look_at(origin=AT["eye"], target=AT["target"], up=(0, 1, 0))
    film = {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1]}
    height = 3.0
    across = 0.5 * height * SIZE[0] / SIZE[1]  # theirs is two wide
    sensors = {
        pn.Camera(**AT, fov=50): {"type": "perspective", "fov": 50.0, "fov_axis": "y", "to_world": at, "film": film},
        pn.Camera.orthographic(**AT, height=height): {
            "type": "orthographic", "to_world": at @ mitsuba.ScalarTransform4f().scale([across, across, 1]), "film": film,
        },
    }
    for camera, description in sensors.items():
        sensor = mitsuba.load_dict(description)
        places = numpy.random.default_rng(2).uniform(0.02, 0.98, (100, 2))
        points = []
        for place in places:
            ray, _ = sensor.sample_ray(0.0, 0.5, list(map(float, place)), [0.5, 0.5])
            points.append(numpy.array(ray.o).ravel() + 4 * numpy.array(ray.d).ravel())
        numpy.testing.assert_allclose(camera.project(points, SIZE), places * SIZE - 0.5, atol=2e-3)


@pytest.mark.parametrize("name", ["orthographic", "panorama", "fisheye", "lens"])
def test_textures_are_averaged_as_wide_as_the_pixels_of_a_camera(name):
    """One sample, filtered, is near the mean of many, and nearer than one that is not filtered."""
    noise = numpy.random.default_rng(5).integers(0, 255, (256, 256, 3), dtype=numpy.uint8)
    floor = numpy.array([[-20, 0, -20], [20, 0, -20], [20, 0, 20], [-20, 0, 20]], numpy.float32)
    scene = pn.Scene(floor, [[0, 2, 1], [0, 3, 2]], uvs=[[0, 0], [6, 0], [6, 6], [0, 6]], ambient=(1, 1, 1),
                     materials=pn.Material(diffuse=(1, 1, 1), texture=noise))
    scene.lights = [pn.Light(position=(0, 5, 0), intensity=0)]
    engine, size = pn.Engine(), (120, 60)
    at = {"eye": (0, 4, 0), "target": (0, 0, -6)}
    pose = numpy.eye(4)
    forward = numpy.subtract(at["target"], at["eye"]) / numpy.linalg.norm(numpy.subtract(at["target"], at["eye"]))
    pose[:3] = numpy.column_stack([(1, 0, 0), numpy.cross(forward, (1, 0, 0)), forward, at["eye"]])
    camera = {
        "orthographic": lambda: pn.Camera.orthographic(**at, height=12),
        "panorama": lambda: pn.Camera.panorama(**at),
        "fisheye": lambda: pn.Camera.fisheye(**at, fov=150),
        "lens": lambda: pn.Camera.from_intrinsics(size, 50, 50, 59.5, 29.5, pose, distortion=[-0.1, 0.01, 0, 0]),
    }[name]()
    truth = engine.render(scene, camera, size, spp=256).color[..., :3]
    seen = engine.render(scene, camera, size).ids != 0xFFFFFFFF
    assert seen.sum() > 1500
    off = {filtered: numpy.sqrt(((engine.render(scene, camera, size, filter_textures=filtered).color[..., :3] - truth)[seen] ** 2).mean())
           for filtered in (True, False)}
    assert off[True] < 0.5 * off[False], off


def test_motion_in_a_panorama_goes_the_shorter_way():
    # A wall behind the eye, where the picture's edges meet.
    wall = pn.Scene([[-3, -3, 5], [3, -3, 5], [3, 3, 5], [-3, 3, 5]], [[0, 2, 1], [0, 3, 2]])
    here, turned = (pn.Camera.panorama(eye=(0, 0, 0), target=target) for target in ((0, 0, -1), (0.05, 0, -1)))
    picture = pn.Engine().render(wall, here, (64, 32))
    seen = picture.ids != 0xFFFFFFFF
    assert seen[16, 0] and seen[16, -1]
    motion = picture.motion(camera=turned)[seen]
    numpy.testing.assert_allclose(abs(motion[:, 0]), 64 * numpy.arctan(0.05) / (2 * numpy.pi), atol=1e-3)
