#version 330 core
// Design 2: the CPU's finished picture, sRGB, to linear light.

uniform sampler2D finished;

out vec4 color;

void main() { color = vec4(texelFetch(finished, ivec2(gl_FragCoord.xy), 0).rgb, 1.0); }
