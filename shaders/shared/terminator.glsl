// Source of GLSL and of C++ (core/shade/shared.h, core/trace/lanes/shared.h): remedies for the shadow terminator, where a coarse mesh's
// shading normals face a light and its facets do not. Expects surface.glsl.

// A lift lower than this part of its triangle is rounding.
const float kLeastLift = 1e-5f;

// From a point that lies under the tangent plane of a vertex with normal n, the way up to that plane.
SHARED vec3 to_tangent_plane(vec3 from_vertex, vec3 n) {
  real square = dot(n, n);
  real height = dot(from_vertex, n);
  return pick(height < 0.0f && square > 0.0f, n * (-height / square), vec3(0.0f));
}

// From the point with these weights on triangle (a, a + ab, a + ac) to the curved surface that the vertex normals
// mean, where that surface bulges (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021). n_geometric and
// the vertex normals look to the same side. Zero: the triangle is flat there, or hollow.
SHARED vec3 terminator_lift(vec3 weights, vec3 ab, vec3 ac, vec3 na, vec3 nb, vec3 nc, vec3 n_geometric) {
  boolean curved = na != nb || na != nc;
  if (!any(curved)) return vec3(0.0f);
  vec3 from_a = ab * weights.y + ac * weights.z;
  vec3 lift = to_tangent_plane(from_a, na) * weights.x + to_tangent_plane(from_a - ab, nb) * weights.y +
              to_tangent_plane(from_a - ac, nc) * weights.z;
  boolean bulges = dot(lift, n_geometric) > kLeastLift * triangle_size(ab, ac);
  return pick(curved && bulges, lift, vec3(0.0f));
}

// Whether light from there is kept although the facet turns away: the lifted point's normal faces it.
SHARED boolean faces_light_lifted(vec3 n_shading, vec3 n_vertices, vec3 to_light) {
  return dot(n_shading, to_light) > 0.0f && dot(n_vertices, to_light) > 0.0f;
}

// What is left of the light, 0 where the facet turns away (Chiang, Li and Burley, "Taming the Shadow Terminator",
// SIGGRAPH 2019 Talks). The light is before n_shading.
SHARED real terminator_factor(vec3 n_shading, vec3 n_geometric, vec3 to_light) {
  real most = dot(n_shading, to_light) * dot(n_shading, n_geometric);
  real g = dot(n_geometric, to_light) / most;
  return pick(most != 0.0f && g < 1.0f, (1.0f + g - g * g) * g, 1.0f);
}
