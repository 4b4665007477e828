// What the pixel sees, from the id that the visibility pass left: the shared sources fed from the scene's
// buffers. Expects the shared sources and scene_fetch.glsl before it.

uniform usampler2D ids;
uniform vec3 eye;
uniform vec3 corner;
uniform vec3 step_x;
uniform vec3 step_y;
uniform vec2 first;

#if ID_BITS == 16
const uint kNoTriangle = 0xffffu;
#elif ID_BITS == 24
const uint kNoTriangle = 0xffffffu;
#else
const uint kNoTriangle = 0xffffffffu;
#endif

uint fetch_id(usampler2D from, ivec2 pixel) {
  uvec4 texel = texelFetch(from, pixel, 0);
#if ID_BITS == 24
  return texel.r | texel.g << 8u | texel.b << 16u;
#else
  return texel.r;
#endif
}

// RGB that travelled as three texels a pixel.
vec3 fetch_rgb(sampler2D from, ivec2 pixel) {
  ivec2 at = ivec2(3 * pixel.x, pixel.y);
  return vec3(texelFetch(from, at, 0).r, texelFetch(from, at + ivec2(1, 0), 0).r, texelFetch(from, at + ivec2(2, 0), 0).r);
}

struct PixelSurface {
  uvec3 corners;
  vec3 weights;
  vec3 p_world;
  vec3 to_viewer;
  FacingNormals n;
};

PixelSurface surface_of(uint id, ivec2 pixel) {
  ViewParams view = ViewParams(eye, corner, step_x, step_y, first);
  vec3 direction = pixel_direction(view, vec2(pixel));
  PixelSurface s;
  s.corners = fetch_corners(id);
  vec3 a = fetch_vec3(positions, s.corners.x);
  vec3 b = fetch_vec3(positions, s.corners.y);
  vec3 c = fetch_vec3(positions, s.corners.z);
  s.weights = barycentric_of(eye, direction, a, b, c);
  s.p_world = point_on_triangle(s.weights, a, b, c);
  s.to_viewer = -normalize(direction);
  vec3 n_geometric = geometric_normal(a, b, c, s.to_viewer);
  vec3 n_shading = shading_normal(s.weights, fetch_vec3(normals, s.corners.x), fetch_vec3(normals, s.corners.y),
                                  fetch_vec3(normals, s.corners.z), n_geometric);
  s.n = face_viewer(n_geometric, n_shading, s.to_viewer);
  return s;
}
