// Source of GLSL and of C++ (core/shade/shared_material.h, core/trace/lanes/shared.h): the shading equation, in linear
// colour,
//   I = Ia + sum over lights of mask * (Id + Is) + emission     (Phong 1975)
// The mirrored and refracted terms Ir and It come from the ray tracer, a generation at a time.
// Expects light_params.glsl and layers.glsl.

// A point's reflection model: Phong's, or glTF's (microfacet.glsl).
struct ShadingParams {
  vec3 ambient;
  vec3 diffuse;    // glTF: base / pi below the layer, limited by matt_limit
  vec3 specular;   // Phong: coefficient. glTF: F0, mirrored at normal incidence
  real shininess;  // Phong: exponent
  vec3 emission;
  real occlusion;  // share of the ambient light that reaches the point
  real ggx_alpha;  // glTF: roughness squared, above 0. Phong: 0
  real grazing;    // glTF: F90, mirrored at grazing incidence
  vec3 layer;      // glTF: F0 and F90 of the dielectric layer on the matt one, in its brightest colour; the share of the
                   // light below it that goes through
  Layers layers;   // glTF: above that
  vec3 coat_normal;  // unit, facing the viewer; set where there is a coat
};

struct Incident {
  vec3 to_light;  // unit
  vec3 radiance;  // zero: the light does not reach this far or this way
  vec3 target;    // p_world of the light, where a shadow ray ends; not set for directional lights
  real density;   // of the direction among all that are sampled, per steradian; 0: the light has no size
};

// The least squared distance to a light: 1 / d^2 stays within float's range.
const float kLeastSquare = 1e-24f;

SHARED real cone_share(LightParams light, vec3 to_light) {
  real cos_angle = dot(-to_light, light.direction);
  real width = light.cos_inner - light.cos_outer;
  real cone = clamp((cos_angle - light.cos_outer) / max(width, 1e-6f), 0.0f, 1.0f);
  return cone * cone;
}

// What a light's range leaves of its radiance at a distance: nothing beyond the range. With inverse-square falloff the
// radiance fades before, by the window that KHR_lights_punctual recommends.
SHARED vec3 within_range(LightParams light, real distance, vec3 radiance) {
  if (light.range > 1e30f) return radiance;  // no range
  vec3 left = pick(distance > light.range, vec3(0.0f), radiance);
  if (!light.inverse_square) return left;
  real q = distance / light.range;
  real q2 = q * q;
  return left * max(1.0f - q2 * q2, 0.0f);
}

// What comes from a point of the light, as if the light had no size.
SHARED Incident incident_light(LightParams light, vec3 position, vec3 p_world) {
  Incident result;
  result.radiance = light.radiance;
  result.target = position;
  result.density = 0.0f;
  if (light.kind == kLightDirectional) {
    result.to_light = -vec3(light.direction);
    return result;
  }
  vec3 offset = position - p_world;
  real distance = length(offset);
  result.to_light = pick(distance > 0.0f, offset * (1.0f / distance), vec3(0.0f, 1.0f, 0.0f));
  result.radiance = within_range(light, distance, result.radiance);
  if (light.inverse_square) result.radiance /= max(distance * distance, kLeastSquare);
  if (light.kind == kLightSpot) result.radiance *= cone_share(light, result.to_light);
  if (has_sides(light)) result.radiance *= max(dot(-result.to_light, light.direction), 0.0f);
  return result;
}

// Whether the light is on the side of the surface that the viewer sees; where it is not, no shadow ray
// is fired and the mask bit is 0. Both normals face the viewer.
SHARED boolean faces_light(vec3 n_shading, vec3 n_geometric, vec3 to_light) {
  return dot(n_shading, to_light) > 0.0f && dot(n_geometric, to_light) > 0.0f;
}

SHARED vec3 phong_ambient(READ_ONLY(ShadingParams) material, vec3 ambient_light) {
  return material.ambient * material.occlusion * ambient_light + material.emission;
}

// Phong's Id + Is of one light where it reaches the point: where `lit` holds, the light is before n. n, to_viewer and
// incident.to_light are unit vectors.
SHARED vec3 phong_light(READ_ONLY(ShadingParams) material, READ_ONLY(Incident) incident, vec3 n, vec3 to_viewer,
                        boolean lit) {
  real n_dot_l = dot(n, incident.to_light);
  vec3 sum = material.diffuse * n_dot_l;
  if (any(lit && material.specular != vec3(0.0f))) {
    vec3 mirrored = n * (2.0f * n_dot_l) - incident.to_light;
    real r_dot_v = dot(mirrored, to_viewer);
    boolean shines = r_dot_v > 0.0f;
    real highlight = pow(pick(shines, r_dot_v, 1.0f), material.shininess);
    sum += material.specular * pick(shines, highlight, 0.0f);
  }
  return incident.radiance * sum;
}
