// Source of GLSL and of C++ (core/shade/shared.h): a light as all shading reads it.

const int kLightPoint = 0;
const int kLightDirectional = 1;
const int kLightSpot = 2;
const int kLightRectangle = 3;

struct LightParams {
  int kind;
  bool inverse_square;  // else the same strength at any distance
  vec3 position;        // p_world; point, spot, rectangle (its centre)
  vec3 direction;       // unit, the way the light travels; directional, spot, rectangle (that it faces)
  vec3 radiance;        // colour times intensity
  float range;
  float cos_inner;
  float cos_outer;
  float size;   // point, spot: the ball's radius; directional: 1 - cos of its disc's; 0: hard shadows
  vec3 edge_u;  // rectangle: its sides
  vec3 edge_v;
};

SHARED bool has_sides(LightParams light) { return light.kind == kLightRectangle; }
SHARED bool has_size(LightParams light) { return light.size > 0.0f || has_sides(light); }
SHARED float area_of_sides(LightParams light) { return length(cross(light.edge_u, light.edge_v)); }
