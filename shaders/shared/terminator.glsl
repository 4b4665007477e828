// Source of GLSL and of C++ (core/trace/shared.h): remedies for the shadow terminator, where a coarse mesh's
// shading normals face a light and its facets do not.

// A lift lower than this part of its triangle is rounding.
const float kLeastLift = 1e-5f;

// How far a point lies under the tangent plane of a vertex with normal n: the way up to it.
SHARED vec3 to_tangent_plane(vec3 from_vertex, vec3 n) {
  float square = dot(n, n);
  float height = dot(from_vertex, n);
  return height < 0.0f && square > 0.0f ? n * (-height / square) : vec3(0.0f);
}

// From the point with these weights on triangle (a, a + ab, a + ac) to the curved surface that the vertex normals
// mean, where that bulges (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021). n_geometric and
// the vertex normals look to the same side. Zero: the triangle is flat there, or hollow.
SHARED vec3 terminator_lift(vec3 weights, vec3 ab, vec3 ac, vec3 na, vec3 nb, vec3 nc, vec3 n_geometric) {
  if (na == nb && na == nc) return vec3(0.0f);
  vec3 from_a = ab * weights.y + ac * weights.z;
  vec3 lift = to_tangent_plane(from_a, na) * weights.x + to_tangent_plane(from_a - ab, nb) * weights.y +
              to_tangent_plane(from_a - ac, nc) * weights.z;
  float size = max(max(max(abs(ab.x), abs(ab.y)), abs(ab.z)), max(max(abs(ac.x), abs(ac.y)), abs(ac.z)));
  return dot(lift, n_geometric) > kLeastLift * size ? lift : vec3(0.0f);
}

// Whether light from there is kept although the facet turns away: the lifted point's normal faces it.
SHARED bool faces_light_lifted(vec3 n_shading, vec3 n_vertices, vec3 to_light) {
  return dot(n_shading, to_light) > 0.0f && dot(n_vertices, to_light) > 0.0f;
}

// What is left of the light, 0 where the facet turns away (Chiang, Li and Burley, "Taming the Shadow Terminator",
// SIGGRAPH 2019 Talks). The light is before both normals.
SHARED float terminator_factor(vec3 n_shading, vec3 n_geometric, vec3 to_light) {
  float most = dot(n_shading, to_light) * dot(n_shading, n_geometric);
  if (most == 0.0f) return 1.0f;
  float g = dot(n_geometric, to_light) / most;
  return g < 1.0f ? (1.0f + g - g * g) * g : 1.0f;
}
