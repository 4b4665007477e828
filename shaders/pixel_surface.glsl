// What the pixel sees, from the id that the visibility pass left: the shared sources fed from the scene's
// buffers.
//   PARALLEL_RAYS  the camera is orthographic

#include "map_fetch.glsl"
#include "shared/terminator.glsl"

uniform usampler2D ids;
uniform vec3 eye;
uniform vec3 corner;
uniform vec3 step_x;
uniform vec3 step_y;
uniform vec2 first;
uniform float texture_spread;  // side of what they are averaged over, pixels; 0: textures are not filtered

#ifdef PARALLEL_RAYS
const bool kParallel = true;
#else
const bool kParallel = false;
#endif

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

// RGB that travelled as one texel a pixel, or as three.
vec3 fetch_rgb(sampler2D from, ivec2 pixel, int texels) {
  if (texels == 1) return texelFetch(from, pixel, 0).rgb;
  ivec2 at = ivec2(3 * pixel.x, pixel.y);
  return vec3(texelFetch(from, at, 0).r, texelFetch(from, at + ivec2(1, 0), 0).r, texelFetch(from, at + ivec2(2, 0), 0).r);
}

ViewParams view_of_picture() {
  return ViewParams(eye, corner, step_x, step_y, first, kParallel);
}

struct PixelSurface {
  vec3 p_world;
  vec3 to_viewer;
  FacingNormals n;       // normal map applied
  ShadingParams material;  // maps applied
  bool transmits;        // refracted rays are traced for it
  float alpha;           // the surface's share; the rest is what a ray sees that goes straight on
#ifdef TERMINATOR_LIFTS
  vec3 n_vertices;  // without normal map
  bool lifts;       // the point is lifted off its facet
#endif
};

bool faces_light(PixelSurface s, vec3 to_light) {
  bool faces = faces_light(s.n.shading, s.n.geometric, to_light);
#ifdef TERMINATOR_LIFTS
  faces = faces || (s.lifts && faces_light_lifted(s.n.shading, s.n_vertices, to_light));
#endif
  return faces;
}

PixelSurface surface_of(uint id, ivec2 pixel) {
  ViewParams view = view_of_picture();
  vec3 origin = pixel_origin(view, vec2(pixel));
  vec3 direction = pixel_direction(view, vec2(pixel));
  uvec3 corners = fetch_corners(id);
  vec3 a = fetch_vec3(positions, corners.x);
  vec3 b = fetch_vec3(positions, corners.y);
  vec3 c = fetch_vec3(positions, corners.z);
  vec3 weights = barycentric_of(origin, direction, a, b - a, c - a);
  PixelSurface s;
  s.p_world = point_on_triangle(weights, a, b - a, c - a);
  s.to_viewer = -normalize(direction);
  vec3 n_geometric = geometric_normal(b - a, c - a, s.to_viewer);
  vec3 n_shading = shading_normal(weights, fetch_vec3(normals, corners.x), fetch_vec3(normals, corners.y),
                                  fetch_vec3(normals, corners.z), n_geometric);
  s.n = face_viewer(n_geometric, n_shading, s.to_viewer);
#ifdef TERMINATOR_LIFTS
  float facing = s.n.leaving ? -1.0 : 1.0;
  s.n_vertices = s.n.shading;
  s.lifts = terminator_lift(weights, b - a, c - a, facing * fetch_vec3(normals, corners.x),
                            facing * fetch_vec3(normals, corners.y), facing * fetch_vec3(normals, corners.z),
                            s.n.geometric) != vec3(0.0);
#endif
  s.alpha = 1.0;
  int material = int(texelFetch(triangle_materials, int(id)).r);
  s.material = fetch_material(material, s.transmits);
  s.material.coat_normal = s.n.shading;
#ifdef HAS_MAPS
  int maps = fetch_maps(material);
  if (maps >= 0) {
    float t = kParallel ? texture_spread : texture_spread * dot(s.p_world - eye, direction) / dot(direction, direction);
    MapPoint point = map_point(corners, weights, b - a, c - a,
                              moved_on_triangle(t * step_x, direction, b - a, c - a),
                              moved_on_triangle(t * step_y, direction, b - a, c - a));
    float side = s.n.leaving ? -1.0 : 1.0;
    vec3 coat_normal = s.n.shading;
    s.n.shading = side * mapped_normal_at(maps, point, side * s.n.shading);
    s.material = mapped_material_at(maps, point, s.material, s.transmits);
    s.material.coat_normal = coat_is_mapped(maps) ? s.n.shading : coat_normal;
    s.alpha = coverage_at(maps, point);
  }
#endif
  if (s.material.ggx_alpha > 0.0) {
    s.material.coat_normal =
        normal_seen(s.material.coat_normal, s.n.geometric, s.to_viewer, coat_alpha(s.material.layers));
    s.n.shading = normal_seen(s.n.shading, s.n.geometric, s.to_viewer, s.material.ggx_alpha);
  }
  s.material = viewed_from(s.to_viewer, s.n.shading, s.material);
  return s;
}
