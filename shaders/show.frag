#version 330 core
// Design 2: the CPU's finished picture, sRGB, to linear light.
//   ID_BITS          16, 24 or 32
//   FINISHED_TEXELS  of the finished picture, a pixel: 1 or 3

#include "pixel_surface.glsl"

uniform sampler2D finished;

out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
#if FINISHED_TEXELS == 1
  vec3 light = texelFetch(finished, pixel, 0).rgb;
#else
  vec3 light = fetch_rgb(finished, pixel);
#endif
  color = vec4(linear_from_srgb(light), fetch_id(ids, pixel) == kNoTriangle ? 0.0 : 1.0);
}
