#version 330 core
// A linear picture as a display shows it: exposure, a tone curve, the sRGB curve, stretched over the window.

#include "shared/glsl.glsl"
#include "shared/tone_map.glsl"

uniform sampler2D picture;
uniform vec2 window_pixels;
uniform float gain;  // 0: black
uniform int tone_curve;
uniform int chequer_pixels;  // side of the squares behind a transparent picture; 0: it is not transparent
uniform bool has_color_behind;
uniform vec3 color_behind;  // in the picture, behind the scene
uniform float zoom;  // 1: the whole picture
uniform vec2 zoom_corner;

out vec4 shown;

vec4 fetch(ivec2 pixel, ivec2 size) {
  return texelFetch(picture, clamp(pixel, ivec2(0), size - 1), 0);
}

// Interpolated between the four pixels around `at`, in linear light.
vec4 interpolate(vec2 at, ivec2 size) {
  ivec2 lo = ivec2(floor(at - 0.5));
  vec2 t = at - 0.5 - vec2(lo);
  vec4 above = mix(fetch(lo, size), fetch(lo + ivec2(1, 0), size), t.x);
  vec4 below = mix(fetch(lo + ivec2(0, 1), size), fetch(lo + ivec2(1, 1), size), t.x);
  return mix(above, below, t.y);
}

vec3 chequered() {
  ivec2 square = ivec2(gl_FragCoord.xy) / chequer_pixels;
  return vec3(((square.x + square.y) & 1) == 0 ? 0.32 : 0.22);
}

// Exposure and tone curve are the scene's. A colour behind it is shown as it is, and so are chequers.
vec3 shown_light(vec4 light) {
  if (chequer_pixels == 0 && !has_color_behind) return tone_mapped(light.rgb * gain, tone_curve);
  float alpha = clamp(light.a, 0.0, 1.0);
  vec3 behind = (1.0 - alpha) * (has_color_behind ? color_behind : chequered());
  if (alpha == 0.0) return behind;
  vec3 own = max(has_color_behind ? light.rgb - behind : light.rgb, vec3(0.0));
  return behind + alpha * tone_mapped(own * (gain / alpha), tone_curve);
}

void main() {
  shown = vec4(0.0, 0.0, 0.0, 1.0);
  if (gain == 0.0) return;
  ivec2 size = textureSize(picture, 0);
  // The picture's row 0 is its top row, the window's its bottom row.
  vec2 in_window = vec2(gl_FragCoord.x, window_pixels.y - gl_FragCoord.y) / window_pixels;
  vec2 at = (zoom > 1.0 ? zoom_corner + in_window / zoom : in_window) * vec2(size);
  vec4 light = vec2(size) == window_pixels || zoom > 1.0 ? fetch(ivec2(at), size) : interpolate(at, size);
  vec3 c = shown_light(light);
  shown.rgb = mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, vec3(greaterThan(c, vec3(0.0031308))));
}
