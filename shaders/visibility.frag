#version 330 core
// Visibility buffer (Burns and Hunt 2013): the triangle's index is all that a pixel keeps.

out uint triangle_id;

void main() { triangle_id = uint(gl_PrimitiveID); }
