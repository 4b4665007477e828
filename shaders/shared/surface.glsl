// Source of GLSL and of C++ (core/trace/shared.h): from a triangle's id to the point that a pixel sees.

// Barycentric weights (of a, b, c) of the point where the ray meets the triangle's plane, moved to the
// nearest edge where rasteriser and ray disagree by a hair: the point is on the triangle, whatever the
// two think of a silhouette pixel. Möller and Trumbore 1997, without the rejection.
SHARED vec3 barycentric_of(vec3 origin, vec3 direction, vec3 a, vec3 b, vec3 c) {
  vec3 edge_ab = b - a;
  vec3 edge_ac = c - a;
  vec3 from_a = origin - a;
  vec3 p = cross(direction, edge_ac);
  float det = dot(edge_ab, p);
  if (det == 0.0f) return vec3(1.0f / 3.0f);  // edge on: every point of it is as good
  float u = clamp(dot(from_a, p) / det, 0.0f, 1.0f);
  float v = clamp(dot(direction, cross(from_a, edge_ab)) / det, 0.0f, 1.0f);
  float sum = u + v;
  if (sum > 1.0f) {
    u /= sum;
    v /= sum;
  }
  return vec3(1.0f - u - v, u, v);
}

SHARED vec3 point_on_triangle(vec3 weights, vec3 a, vec3 b, vec3 c) {
  return a + weights.y * (b - a) + weights.z * (c - a);
}

// The triangle's own normal by its winding; a sliver without area has none and answers with `fallback`.
SHARED vec3 geometric_normal(vec3 a, vec3 b, vec3 c, vec3 fallback) {
  vec3 ab = b - a;
  vec3 ac = c - a;
  // Scaled first: a cross product of edges of 1e-12 or 1e+20 would leave float's range.
  float size = max(max(max(abs(ab.x), abs(ab.y)), abs(ab.z)), max(max(abs(ac.x), abs(ac.y)), abs(ac.z)));
  if (size == 0.0f) return fallback;
  vec3 n = cross(ab / size, ac / size);
  float square = dot(n, n);
  return square > 0.0f ? n / sqrt(square) : fallback;
}

// Vertex normals weighted; where they are zero or cancel, the geometric normal.
SHARED vec3 shading_normal(vec3 weights, vec3 na, vec3 nb, vec3 nc, vec3 n_geometric) {
  vec3 n = weights.x * na + weights.y * nb + weights.z * nc;
  float square = dot(n, n);
  return square > 1e-12f ? n / sqrt(square) : n_geometric;
}

// Both normals on the viewer's side.
struct FacingNormals {
  vec3 geometric;
  vec3 shading;
  bool leaving;  // the viewer is inside: behind the surface
};

SHARED FacingNormals face_viewer(vec3 n_geometric, vec3 n_shading, vec3 to_viewer) {
  // Where winding and vertex normals disagree about the outside, the normals are right.
  if (dot(n_geometric, n_shading) < 0.0f) n_geometric = -n_geometric;
  bool leaving = dot(n_geometric, to_viewer) < 0.0f;
  float side = leaving ? -1.0f : 1.0f;
  FacingNormals result;
  result.geometric = side * n_geometric;
  result.shading = side * n_shading;
  result.leaving = leaving;
  return result;
}
