#version 330 core
// Visibility buffer (Burns and Hunt 2013): the triangle's index is all that a pixel keeps.
//   ID_BITS  16 or 32: one number; 24: three bytes

#if ID_BITS == 24
out uvec4 triangle_id;

void main() {
  uint id = uint(gl_PrimitiveID);
  triangle_id = uvec4(id & 0xffu, id >> 8u & 0xffu, id >> 16u, 0u);
}
#else
out uint triangle_id;

void main() { triangle_id = uint(gl_PrimitiveID); }
#endif
