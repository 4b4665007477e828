#version 330 core
// The mean of the samples before and one more (inspect/accumulator.h).

uniform sampler2D picture;
uniform sampler2D average;
uniform int samples;  // in `average`; 0: it holds nothing

out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  color = texelFetch(picture, pixel, 0);
  if (color.a == 1.0 - 1.0 / 2048.0) color.a = 1.0;  // a reprojected picture's hole is covered too
  if (samples == 0) return;
  vec4 before = texelFetch(average, pixel, 0);
  color = before + (color - before) / float(samples + 1);
}
