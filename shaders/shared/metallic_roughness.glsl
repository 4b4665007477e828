// Source of GLSL and of C++ (core/shade/shared_material.h, core/trace/lanes/shared.h): glTF's metallic-roughness material as
// the parameters of its reflection model, or as Phong's, for a whole material where it is loaded and for each point where
// textures change it. Expects phong.glsl and microfacet.glsl.
//   f0 = min(((ior-1)/(ior+1))^2 specular_color, 1) specular         mirrored at normal incidence, dielectric
//   F0 = mix(f0, base, metallic), F90 = mix(specular, 1, metallic)
//   ambient     base (1 - transmission)
// glTF's model (microfacet.glsl):
//   diffuse     base (1 - metallic) (1 - transmission) / pi
//   specular    F0, alpha = roughness^2
//   above it, where nothing is transmitted: KHR_materials_clearcoat and _sheen
// Phong's:
//   diffuse     base (1 - max f0) (1 - metallic) (1 - transmission) / pi
//   shininess s a quarter of Blinn's 2/r^4 - 2 (Karis 2013), within [1, 10000]
//   specular    F0 (s + 2) / (2 pi)                                 keeps the highlight's energy (Lewis 1993)
// Both, where mirrors are not sampled:
//   reflectance F0 max(0, 1 - roughness/0.25)^2, with Fresnel       our own falloff: above a roughness of a
//                                                                   quarter a sharp mirror misleads
// Transmission refracts where there is a volume; without one the surface is infinitely thin, and light goes
// straight on (ior 1). Unlit: only the base colour is emitted.

const float kOneByPi = 0.318309886183790671538f;
const float kRoughestMirror = 0.25f;
const float kLeastReflectance = 1.0f / 255.0f;  // weaker mirrors are not worth a ray
const float kLeastTransmission = 1.5f / 255.0f;  // less is a metal's texture that is one step from 1

struct MetallicRoughness {
  vec3 base_color;
  real metallic;
  real roughness;
  vec3 emissive;
  real ior;
  real specular;
  vec3 specular_color;
  real transmission;
  bool volume;
  bool unlit;
};

// The whole material at a point.
struct MaterialPoint {
  ShadingParams shading;
  vec3 reflectance;
  vec3 transmittance;
  real ior;
  boolean fresnel;
};

SHARED real largest_of(vec3 v) { return max(max(v.x, v.y), v.z); }

SHARED ShadingParams phong_params(vec3 ambient, vec3 diffuse, vec3 specular, real shininess, vec3 emission) {
  ShadingParams m;
  m.ambient = ambient;
  m.diffuse = diffuse;
  m.specular = specular;
  m.shininess = shininess;
  m.emission = emission;
  m.occlusion = 1.0f;
  m.ggx_alpha = 0.0f;
  m.grazing = 1.0f;
  m.layer = vec3(0.0f);
  m.layers = no_layers();
  m.coat_normal = vec3(0.0f);
  return m;
}

SHARED MaterialPoint material_point(READ_ONLY(ShadingParams) shading) {
  MaterialPoint point;
  point.shading = shading;
  point.reflectance = vec3(0.0f);
  point.transmittance = vec3(0.0f);
  point.ior = 1.0f;
  point.fresnel = none();
  return point;
}

SHARED real shininess_of(real roughness) {
  real r2 = roughness * roughness;
  return clamp(0.25f * (2.0f / max(r2 * r2, 1e-8f) - 2.0f), 1.0f, 10000.0f);
}

// The share of a mirror where it stays sharp.
SHARED real sharp_share(real roughness) {
  real sharp = max(0.0f, 1.0f - roughness / kRoughestMirror);
  return sharp * sharp;
}

SHARED MaterialPoint from_metallic_roughness(READ_ONLY(MetallicRoughness) s, bool as_phong) {
  if (s.unlit) return material_point(phong_params(vec3(0.0f), vec3(0.0f), vec3(0.0f), 1.0f, s.base_color));
  real root = (s.ior - 1.0f) / (s.ior + 1.0f);
  vec3 dielectric_f0 = min(root * root * s.specular_color, vec3(1.0f)) * s.specular;
  vec3 f0 = mix(dielectric_f0, s.base_color, s.metallic);
  real opaque = (1.0f - s.metallic) * (1.0f - s.transmission);
  ShadingParams shading = phong_params(s.base_color * (1.0f - s.transmission), s.base_color * opaque * kOneByPi, f0,
                                       shininess_of(s.roughness), s.emissive);
  if (as_phong) {
    shading.diffuse = s.base_color * (1.0f - largest_of(dielectric_f0)) * opaque * kOneByPi;
    shading.specular = f0 * (shading.shininess + 2.0f) * (0.5f * kOneByPi);
  } else {
    shading.ggx_alpha = clamp(s.roughness * s.roughness, kLeastAlpha, 1.0f);
    shading.grazing = mix(min(s.specular, 1.0f), 1.0f, s.metallic);
    shading.layer = vec3(largest_of(dielectric_f0), min(s.specular, 1.0f), s.transmission);
  }
  MaterialPoint m = material_point(shading);
  boolean transmits = s.transmission * (1.0f - s.metallic) > kLeastTransmission;
  m.transmittance = pick(transmits, s.base_color * (s.transmission * (1.0f - s.metallic)), vec3(0.0f));
  if (s.volume) m.ior = pick(transmits, s.ior, 1.0f);
  vec3 mirror = f0 * sharp_share(s.roughness);
  m.fresnel = !transmits && largest_of(mirror) > kLeastReflectance;
  m.reflectance = pick(m.fresnel, mirror, vec3(0.0f));
  return m;
}

// Adds the layers to a material of glTF's model. On glass they are left out.
SHARED MaterialPoint with_layers(READ_ONLY(MaterialPoint) m, READ_ONLY(Layers) l) {
  MaterialPoint layered = m;
  boolean above = m.shading.ggx_alpha != 0.0f && m.transmittance == vec3(0.0f);
  layered.shading.layers = pick_layers(above, l, m.shading.layers);
  real coat_f0 = kCoatF0 * l.coat;
  vec3 mirror = m.reflectance * (1.0f - coat_f0) + vec3(coat_f0 * sharp_share(l.coat_roughness));
  boolean mirrors = above && largest_of(mirror) > kLeastReflectance;
  layered.reflectance = pick(mirrors, mirror, m.reflectance);
  layered.fresnel = m.fresnel || mirrors;
  return layered;
}
