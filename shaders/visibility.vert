#version 330 core
// Every triangle of the scene in one draw; the fragment's primitive id is the triangle's index.

layout(location = 0) in vec3 p_world;

uniform vec3 eye;
uniform mat3 picture_from_eye;  // (p_world - eye) to clip x, y, w; row 0 of the picture is GL's row 0
#ifdef PARALLEL_RAYS
uniform vec2 half_pixel;
uniform float z_far;
#else
uniform float z_near;
#endif

void main() {
  // Relative to the eye first: far from the origin a combined matrix would lose the digits that matter.
  vec3 clip = picture_from_eye * (p_world - eye);
#ifdef PARALLEL_RAYS
  gl_Position = vec4(clip.xy + half_pixel - 1.0, 1.0 - clip.z / z_far, 1.0);  // reversed, linear depth
#else
  gl_Position = vec4(clip.xy, z_near, clip.z);  // reversed, infinite depth: z_near / z_eye
#endif
}
