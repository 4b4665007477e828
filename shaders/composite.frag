#version 330 core
// Phong per light times its mask bit, plus the traced reflection: the picture. Phong and composite are one
// pass, as the mask weighs each light by itself and the sum of lights cannot be weighed afterwards.
//   HAS_MASK        the CPU's shadow mask, MASK_BITS a pixel; without it every light reaches everything
//   HAS_REFLECTION  the CPU's mirrored and refracted light
//   HAS_TEXTURES    some material has a texture

#define SHARED
#include "shared/view.glsl"
#include "shared/surface.glsl"
#include "shared/phong.glsl"
#include "scene_fetch.glsl"

uniform usampler2D ids;
uniform uint no_triangle;
uniform vec3 eye;
uniform vec3 corner;
uniform vec3 step_x;
uniform vec3 step_y;
uniform vec2 first;
uniform vec3 ambient_light;
uniform int light_count;
#ifdef HAS_MASK
uniform usampler2D mask;
#endif
#ifdef HAS_REFLECTION
uniform sampler2D reflection;
#endif

out vec4 color;

const float kLargestHalf = 65504.0;

bool light_reaches(ivec2 pixel, int slot) {
#ifdef HAS_MASK
  if (slot < 0) return true;
  int bit = pixel.x * MASK_BITS + slot;
  uint byte_of_mask = texelFetch(mask, ivec2(bit / 8, pixel.y), 0).r;
  return (byte_of_mask >> uint(bit % 8) & 1u) != 0u;
#else
  return true;
#endif
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint id = texelFetch(ids, pixel, 0).r;
  color = vec4(0.0);
  if (id == no_triangle) return;

  ViewParams view = ViewParams(eye, corner, step_x, step_y, first);
  vec3 direction = pixel_direction(view, vec2(pixel));
  uvec3 corners = fetch_corners(id);
  vec3 a = fetch_vec3(positions, corners.x), b = fetch_vec3(positions, corners.y), c = fetch_vec3(positions, corners.z);
  vec3 weights = barycentric_of(eye, direction, a, b, c);
  vec3 p_world = point_on_triangle(weights, a, b, c);
  vec3 to_viewer = -normalize(direction);
  vec3 n_geometric = geometric_normal(a, b, c, to_viewer);
  vec3 n_shading = shading_normal(weights, fetch_vec3(normals, corners.x), fetch_vec3(normals, corners.y),
                                  fetch_vec3(normals, corners.z), n_geometric);
  FacingNormals n = face_viewer(n_geometric, n_shading, to_viewer);

  PhongParams material = fetch_material(id, corners, weights);
  vec3 sum = phong_ambient(material, ambient_light);
  for (int i = 0; i < light_count; ++i) {
    if (!light_reaches(pixel, fetch_mask_slot(i))) continue;
    Incident incident = incident_light(fetch_light(i), p_world);
    if (!faces_light(n.shading, n.geometric, incident.to_light)) continue;
    sum += phong_light(material, incident, n.shading, to_viewer);
  }
#ifdef HAS_REFLECTION
  sum += texelFetch(reflection, pixel, 0).rgb;
#endif
  color = vec4(min(sum, kLargestHalf), 1.0);
}
