#version 330 core
// Luminance and brightest channel of every step-th pixel, across and down.

uniform sampler2D picture;
uniform int step_pixels;

out vec2 light;

void main() {
  vec3 c = texelFetch(picture, ivec2(gl_FragCoord.xy) * step_pixels, 0).rgb;
  light = vec2(dot(c, vec3(0.2126, 0.7152, 0.0722)), max(max(c.r, c.g), c.b));  // Rec. 709
}
