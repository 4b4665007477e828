#version 330 core
// Visibility buffer (Burns and Hunt 2013): the triangle's index is all that a pixel keeps.
//   ID_BITS  16 or 32: one number; 24: three bytes
//   HAS_HOLES  some materials' maps have holes, which are not drawn
//   PARALLEL_RAYS  the camera is orthographic
//   PASSES_BACKS  the backs of some materials are not drawn

#ifdef HAS_HOLES
#include "map_fetch.glsl"

uniform vec3 eye;
uniform vec3 corner;
uniform vec3 step_x;
uniform vec3 step_y;
uniform vec2 first_pixel;  // the part's, of the picture
#ifdef PARALLEL_RAYS
const bool kParallel = true;
#else
const bool kParallel = false;
#endif

// Decided where the pixel's ray meets the triangle, as the ray tracer does.
void discard_hole() {
  int id = gl_PrimitiveID;
  int maps = fetch_maps(int(texelFetch(triangle_materials, id).r));
  if (maps < 0) return;
  ViewParams view = ViewParams(eye, corner, step_x, step_y, vec2(0.0), kParallel);
  vec2 pixel = floor(gl_FragCoord.xy) + first_pixel;
  vec3 direction = pixel_direction(view, pixel);
  uvec3 corners = fetch_corners(uint(id));
  vec3 a = fetch_vec3(positions, corners.x);
  vec3 b = fetch_vec3(positions, corners.y);
  vec3 c = fetch_vec3(positions, corners.z);
  vec3 weights = barycentric_of(pixel_origin(view, pixel), direction, a, b - a, c - a);
  MapPoint point = map_point(corners, weights, b - a, c - a, vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0));
  if (hole_at(maps, point)) discard;
}
#else
void discard_hole() {}
#endif

#ifdef PASSES_BACKS
#ifndef HAS_HOLES
uniform usamplerBuffer triangle_materials;  // 1 texel a triangle
#endif
uniform usamplerBuffer passed_backs;  // 1 texel a material: bit i says whether setting i leaves out its backs
uniform int backfaces;                // the setting

void discard_back() {
  if (gl_FrontFacing) return;
  int material = int(texelFetch(triangle_materials, gl_PrimitiveID).r);
  if ((texelFetch(passed_backs, material).r >> backfaces & 1u) != 0u) discard;
}
#else
void discard_back() {}
#endif

#if ID_BITS == 24
out uvec4 triangle_id;

void main() {
  discard_back();
  discard_hole();
  uint id = uint(gl_PrimitiveID);
  triangle_id = uvec4(id & 0xffu, id >> 8u & 0xffu, id >> 16u, 0u);
}
#else
out uint triangle_id;

void main() {
  discard_back();
  discard_hole();
  triangle_id = uint(gl_PrimitiveID);
}
#endif
