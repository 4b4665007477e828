#version 330 core
// The buffers that the slides send beside the id, computed from the id.
//   ID_BITS       16, 24 or 32
//   NORMALS_ONLY  design 1: the shading normal, 0.5 n + 0.5, in three bytes
//   else          design 2: 128 bits a pixel: the id; the shading normal's x and y as two signed 16-bit
//                 fractions, its z's sign in the lowest bit of x; z_eye as a float; the diffuse colour in
//                 four bytes

#include "pixel_surface.glsl"

#ifdef NORMALS_ONLY
out vec4 normal;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint id = fetch_id(ids, pixel);
  normal = vec4(0.5, 0.5, 0.5, 1.0);
  if (id != kNoTriangle) normal.rgb = 0.5 * surface_of(id, pixel).n.shading + 0.5;
}
#else
out uvec4 surface;

uint fraction16(float x) { return uint(int(round(clamp(x, -1.0, 1.0) * 32767.0))) & 0xffffu; }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint id = fetch_id(ids, pixel);
  const uint kInfinity = 0x7f800000u;  // a float's bits: GLSL need not have one, nor divide by zero
  surface = uvec4(0xffffffffu, 0u, kInfinity, 0u);
  if (id == kNoTriangle) return;
  PixelSurface s = surface_of(id, pixel);
  vec3 n = s.n.shading;
  uint packed_normal = (fraction16(n.x) & 0xfffeu) | (n.z < 0.0 ? 1u : 0u) | fraction16(n.y) << 16u;
  vec3 forward = normalize(cross(step_y, step_x));
  float z_eye = dot(s.p_world - eye, forward);
  vec3 diffuse = clamp(s.material.diffuse, 0.0, 1.0);
  uvec3 rgb = uvec3(round(diffuse * 255.0));
  surface = uvec4(id, packed_normal, floatBitsToUint(z_eye), rgb.r | rgb.g << 8u | rgb.b << 16u | 0xff000000u);
}
#endif
