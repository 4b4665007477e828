#version 330 core
// Design 2: the CPU's finished picture, sRGB, to linear light.
//   ID_BITS          16, 24 or 32
//   FINISHED_TEXELS  of the finished picture, a pixel: 1 or 3

#include "pixel_surface.glsl"

uniform sampler2D finished;

out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 light = linear_from_srgb(fetch_rgb(finished, pixel, FINISHED_TEXELS));
  color = vec4(light, fetch_id(ids, pixel) == kNoTriangle ? 0.0 : 1.0);
}
