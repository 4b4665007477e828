// Source of GLSL and of C++ (core/trace/shared.h): the shading equation, in linear colour,
//   I = Ia + sum over lights of mask * (Id + Is) + emission     (Phong 1975)
// The mirrored and refracted terms Ir and It come from the ray tracer, a generation at a time.

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

struct PhongParams {
  vec3 ambient;
  vec3 diffuse;
  vec3 specular;
  float shininess;
  vec3 emission;
};

struct Incident {
  vec3 to_light;  // unit
  vec3 radiance;  // zero: the light does not reach this far or this way
  vec3 target;    // p_world of the light, where a shadow ray ends; not of a directional one
};

SHARED float cone_share(LightParams light, vec3 to_light) {
  float cos_angle = dot(-to_light, light.direction);
  float cone = clamp((cos_angle - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1e-6f), 0.0f, 1.0f);
  return cone * cone;
}

// Of a light as if it had no size.
SHARED Incident incident_light(LightParams light, vec3 p_world) {
  Incident result;
  result.radiance = light.radiance;
  result.target = light.position;
  if (light.kind == kLightDirectional) {
    result.to_light = -light.direction;
    return result;
  }
  vec3 offset = light.position - p_world;
  float distance = length(offset);
  result.to_light = distance > 0.0f ? offset / distance : vec3(0.0f, 1.0f, 0.0f);
  if (distance > light.range) result.radiance = vec3(0.0f);
  if (light.inverse_square) result.radiance /= max(distance * distance, 1e-12f);
  if (light.kind == kLightSpot) result.radiance *= cone_share(light, result.to_light);
  if (light.kind == kLightRectangle) result.radiance *= max(dot(-result.to_light, light.direction), 0.0f);
  return result;
}

// Whether the light is on the side of the surface that the viewer sees; where it is not, no shadow ray
// is fired and the mask bit is 0. Both normals face the viewer.
SHARED bool faces_light(vec3 n_shading, vec3 n_geometric, vec3 to_light) {
  return dot(n_shading, to_light) > 0.0f && dot(n_geometric, to_light) > 0.0f;
}

SHARED vec3 phong_ambient(PhongParams material, vec3 ambient_light) {
  return material.ambient * ambient_light + material.emission;
}

// Id + Is of one light that reaches the point. n, to_viewer and incident.to_light are unit vectors.
SHARED vec3 phong_light(PhongParams material, Incident incident, vec3 n, vec3 to_viewer) {
  float n_dot_l = dot(n, incident.to_light);
  if (n_dot_l <= 0.0f) return vec3(0.0f);
  vec3 mirrored = 2.0f * n_dot_l * n - incident.to_light;
  float r_dot_v = max(dot(mirrored, to_viewer), 0.0f);
  float highlight = r_dot_v > 0.0f ? pow(r_dot_v, material.shininess) : 0.0f;
  return incident.radiance * (material.diffuse * n_dot_l + material.specular * highlight);
}
