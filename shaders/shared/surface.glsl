// Source of GLSL and of C++ (core/shade/shared.h, core/trace/lanes/shared.h): from a triangle's id to the point that a
// pixel sees. A triangle is (a, a + ab, a + ac).

// Barycentric weights (of a, b, c) of the point where the ray meets the triangle's plane, moved to the
// nearest edge where rasteriser and ray disagree by a hair: the point is on the triangle, whatever the
// two think of a silhouette pixel. Moeller and Trumbore 1997, without the rejection.
SHARED vec3 barycentric_of(vec3 origin, vec3 direction, vec3 a, vec3 ab, vec3 ac) {
  vec3 from_a = origin - a;
  vec3 p = cross(direction, ac);
  real det = dot(ab, p);
  real u = clamp(dot(from_a, p) / det, 0.0f, 1.0f);
  real v = clamp(dot(direction, cross(from_a, ab)) / det, 0.0f, 1.0f);
  real sum = u + v;
  boolean beyond = sum > 1.0f;
  if (any(beyond)) {
    u = pick(beyond, u / sum, u);
    v = pick(beyond, v / sum, v);
  }
  // Edge on, every point of the triangle is as good.
  return pick(det == 0.0f, vec3(1.0f / 3.0f), vec3(1.0f - u - v, u, v));
}

SHARED vec3 point_on_triangle(vec3 weights, vec3 a, vec3 ab, vec3 ac) { return a + weights.y * ab + weights.z * ac; }

// The largest component of the two edges.
SHARED real triangle_size(vec3 ab, vec3 ac) {
  return max(max(max(abs(ab.x), abs(ab.y)), abs(ab.z)), max(max(abs(ac.x), abs(ac.y)), abs(ac.z)));
}

// The triangle's own normal by its winding; `fallback` for a sliver without area, which has none.
SHARED vec3 geometric_normal(vec3 ab, vec3 ac, vec3 fallback) {
  // Scaled first: a cross product of edges of 1e-12 or 1e+20 would leave float's range.
  real size = triangle_size(ab, ac);
  real inverse = 1.0f / size;
  vec3 n = cross(ab * inverse, ac * inverse);
  real square = dot(n, n);
  return pick(size > 0.0f && square > 0.0f, n * (1.0f / sqrt(square)), fallback);
}

// The weighted vertex normals; where they are zero or cancel, the geometric normal.
SHARED vec3 shading_normal(vec3 weights, vec3 na, vec3 nb, vec3 nc, vec3 n_geometric) {
  vec3 n = weights.x * na + weights.y * nb + weights.z * nc;
  real square = dot(n, n);
  return pick(square > 1e-12f, n * (1.0f / sqrt(square)), n_geometric);
}

// Both normals on the viewer's side.
struct FacingNormals {
  vec3 geometric;
  vec3 shading;
  boolean leaving;  // the viewer is inside: behind the surface
};

SHARED FacingNormals face_viewer(vec3 n_geometric, vec3 n_shading, vec3 to_viewer) {
  // Where winding and vertex normals disagree about the outside, the normals are right.
  vec3 outwards = pick(dot(n_geometric, n_shading) < 0.0f, -n_geometric, n_geometric);
  FacingNormals result;
  result.leaving = dot(outwards, to_viewer) < 0.0f;
  result.geometric = pick(result.leaving, -outwards, outwards);
  result.shading = pick(result.leaving, -n_shading, n_shading);
  return result;
}
