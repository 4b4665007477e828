"""Random rays of meshes: the tracer beside Embree (trimesh with embreex)."""
import numpy
import pinocchio_renderer as pn
import pytest

trimesh = pytest.importorskip("trimesh")
pytest.importorskip("embreex")
from trimesh.ray.ray_pyembree import RayMeshIntersector  # noqa: E402

# Given, as some versions of trimesh draw their own from the system, whatever seed NumPy has.
TURNS = numpy.random.default_rng(7).random((5, 3))
MESHES = {
    "sphere": lambda: trimesh.creation.icosphere(subdivisions=4),
    "torus": lambda: trimesh.creation.torus(1.0, 0.3),
    "boxes": lambda: trimesh.util.concatenate(
        [trimesh.creation.box((0.2, 0.3, 0.4), trimesh.transformations.random_rotation_matrix(u)) for u in TURNS]
    ),
}
RAYS = 20000


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]()


def rays(seed):
    random = numpy.random.default_rng(seed)
    directions = random.normal(size=(RAYS, 3))
    origins = -2 * directions / numpy.linalg.norm(directions, axis=1)[:, None] + random.uniform(-1, 1, (RAYS, 3))
    return origins.astype(numpy.float32), directions.astype(numpy.float32)


def distances(mesh, triangles, origins, directions):
    """(n,) distances along the rays to the planes of `triangles`, in double precision."""
    normals = mesh.face_normals[triangles]
    towards = numpy.einsum("ij,ij->i", mesh.triangles[triangles, 0] - origins, normals)
    return towards / numpy.einsum("ij,ij->i", directions, normals)


def test_hits_are_embrees(mesh):
    origins, directions = rays(1)
    t, triangle = pn.Tracer(mesh.vertices, mesh.faces).closest_hits(origins, directions)
    theirs = RayMeshIntersector(mesh).intersects_first(origins, directions)
    ours = triangle.astype(numpy.int64)
    ours[triangle == 0xFFFFFFFF] = -1
    assert numpy.isinf(t[ours < 0]).all() and numpy.isfinite(t[ours >= 0]).all()
    # Along an edge either neighbour will do, and where two boxes cut each other either box; nowhere else do they differ.
    other = numpy.flatnonzero(ours != theirs)
    assert len(other) <= RAYS // 500
    both = other[(ours[other] >= 0) & (theirs[other] >= 0)]
    apart = [distances(mesh, which[both], origins[both], directions[both]) for which in (ours, theirs)]
    numpy.testing.assert_allclose(*apart, rtol=1e-5)
    # The point lies in the plane of the triangle.
    hit = ours >= 0
    points = origins[hit] + t[hit, None] * directions[hit]
    corner = mesh.triangles[ours[hit], 0]
    off = numpy.einsum("ij,ij->i", points - corner, mesh.face_normals[ours[hit]])
    assert numpy.abs(off).max() < 1e-5


def test_occlusion_is_a_hit_within_reach(mesh):
    origins, directions = rays(2)
    tracer = pn.Tracer(mesh.vertices, mesh.faces, threads=2)
    t, _ = tracer.closest_hits(origins, directions)
    numpy.testing.assert_array_equal(tracer.occluded(origins, directions), numpy.isfinite(t))
    reach = numpy.full(RAYS, 1.0, numpy.float32)
    away = numpy.abs(t - 1.0) > 1e-6
    within = tracer.occluded(origins, directions, reach)
    numpy.testing.assert_array_equal(within[away], (t < 1.0)[away])
    numpy.testing.assert_array_equal(tracer.occluded(origins, directions, 1.0), within)
    with pytest.raises(pn.Error, match="one for all"):
        tracer.occluded(origins, directions, reach[:2])


def test_one_origin_for_all():
    tracer = pn.Tracer(*quad())
    directions = numpy.array([[0, 0, -1], [0, 0, 1], [0.1, 0.1, -1]], numpy.float32)
    t, triangle = tracer.closest_hits(numpy.array([[0.1, 0.2, 2]], numpy.float32), directions)
    assert t.tolist() == [2.0, numpy.inf, 2.0]
    assert triangle[1] == 0xFFFFFFFF


def quad():
    vertices = numpy.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], numpy.float32)
    return vertices, numpy.array([[0, 1, 2], [0, 2, 3]])


def test_threads_are_the_programs(monkeypatch):
    vertices, triangles = quad()
    for wrong in (-1, 1025, 2**31 - 1):
        with pytest.raises(pn.Error, match="threads must be from 0 .* to 1024"):
            pn.Tracer(vertices, triangles, threads=wrong)
    with pytest.raises(TypeError):
        pn.Tracer(vertices, triangles, threads=2.5)
    origins, directions = numpy.zeros((1, 3)), numpy.random.default_rng(3).normal(size=(20000, 3))
    hits = [pn.Tracer(vertices, triangles, threads=n).closest_hits(origins, directions) for n in (1, 7)]
    monkeypatch.setenv("PINOCCHIO_THREADS", "3")
    hits.append(pn.Tracer(vertices, triangles).closest_hits(origins, directions))
    for other in hits[1:]:
        assert all(numpy.array_equal(a, b) for a, b in zip(hits[0], other))


def test_rays_of_a_scene(scenes):
    scene = pn.load_scene(scenes / "two-lights.gltf")
    camera = pn.Camera.from_intrinsics((80, 60), 70, 70, 39.5, 29.5, look_at((0.4, 1.5, 3.0), (0, 0.3, 0)))
    result = pn.Engine().render(scene, camera, size=(80, 60))
    v, u = numpy.indices((60, 80))
    pose = look_at((0.4, 1.5, 3.0), (0, 0.3, 0))
    directions = numpy.stack([(u - 39.5) / 70, (v - 29.5) / 70, numpy.ones((60, 80))], -1).reshape(-1, 3)
    directions = 3 * directions @ pose[:3, :3].T  # of any length
    hits = pn.Tracer(scene).closest_hits(pose[None, :3, 3], directions)
    t, triangle = hits
    assert len(hits) == 2 and numpy.array_equal(hits[0], t) and numpy.array_equal(hits[-1], triangle)
    same = (triangle == result.ids.ravel()) & (triangle != 0xFFFFFFFF)
    assert same.sum() > 1000 and (triangle == result.ids.ravel()).mean() > 0.995
    numpy.testing.assert_allclose(hits.distance, t * numpy.linalg.norm(directions, axis=1), rtol=1e-5)
    numpy.testing.assert_allclose(hits.position[same], result.position.reshape(-1, 3)[same], atol=2e-4)
    numpy.testing.assert_array_equal(hits.node[same], result.objects.ravel()[same])
    numpy.testing.assert_array_equal(hits.material[same], scene.triangle_materials[triangle[same]])
    corners = scene.vertices[scene.triangles[triangle[same]]]
    numpy.testing.assert_allclose(numpy.einsum("nc,nci->ni", hits.barycentrics[same], corners), hits.position[same], atol=1e-5)
    apart = numpy.einsum("ni,ni->n", hits.normal[same], result.normal.reshape(-1, 3)[same])
    assert numpy.median(apart) > 0.9999 and (apart > 0.99).mean() > 0.98
    facing = numpy.einsum("ni,ni->n", hits.triangle_normal[same], directions[same])
    assert (facing <= 0).all()
    missed = triangle == 0xFFFFFFFF
    assert (hits.node[missed] == 0xFFFFFFFF).all() and not hits.normal[missed].any() and numpy.isinf(hits.distance[missed]).all()


def test_rays_of_a_posed_scene():
    part = pn.Scene(*quad())
    scene = pn.assemble({"floor": part, "plate": part})
    pose = numpy.eye(4)
    pose[2, 3] = 1.5
    ray = numpy.array([[0.2, 0.3, 4]]), numpy.array([[0, 0, -2.0]])
    for moved, distance, node in [(scene, 4.0, 0), (scene.posed({"plate": pose}), 2.5, 1)]:
        hits = pn.Tracer(moved, threads=1).closest_hits(*ray)
        assert (hits.distance[0], hits.t[0], hits.node[0]) == (distance, distance / 2, node)
        numpy.testing.assert_allclose(hits.triangle_normal, [[0, 0, 1]])
    assert not pn.Tracer(scene).occluded(*ray, [1.9]).any() and pn.Tracer(scene).occluded(*ray, [2.1]).all()


def look_at(eye, target):
    """A camera-to-world matrix with OpenCV's axes."""
    forward = numpy.subtract(target, eye) / numpy.linalg.norm(numpy.subtract(target, eye))
    right = numpy.cross(forward, (0, 1, 0))
    right /= numpy.linalg.norm(right)
    pose = numpy.eye(4)
    pose[:3] = numpy.column_stack([right, numpy.cross(forward, right), forward, eye])
    return pose
