// Source of GLSL and of C++ (core/shade/shared_material.h): glTF's metallic-roughness material as Phong's, for
// a whole material where it is loaded and for each point where textures change it. Expects phong.glsl.
//   f0 = ((ior-1)/(ior+1))^2 specular specular_color, at most 1     mirrored at normal incidence, dielectric
//   F0 = mix(f0, base, metallic)
//   diffuse     base (1 - max f0) (1 - metallic) (1 - transmission) / pi
//   shininess s a quarter of Blinn's 2/r^4 - 2 (Karis 2013), within [1, 10000]
//   specular    F0 (s + 2) / (2 pi)                                 keeps the highlight's energy (Lewis 1993)
//   reflectance F0 max(0, 1 - roughness/0.25)^2, with Fresnel       our own falloff: above a roughness of a
//                                                                   quarter a sharp mirror misleads
//   ambient     base (1 - transmission)
// Transmission refracts where there is a volume; without one the surface is infinitely thin, and light goes
// straight on (ior 1). Unlit: only the base colour is emitted.

const float kOneByPi = 0.318309886183790671538f;
const float kRoughestMirror = 0.25f;
const float kLeastReflectance = 1.0f / 255.0f;  // weaker mirrors are not worth a ray

struct MetallicRoughness {
  vec3 base_color;
  float metallic;
  float roughness;
  vec3 emissive;
  float ior;
  float specular;
  vec3 specular_color;
  float transmission;
  bool volume;
  bool unlit;
};

// The whole material at a point.
struct PhongSurface {
  PhongParams phong;
  vec3 reflectance;
  vec3 transmittance;
  float ior;
  bool fresnel;
};

SHARED float largest_of(vec3 v) { return max(max(v.x, v.y), v.z); }

SHARED PhongSurface phong_surface(PhongParams phong) {
  PhongSurface surface;
  surface.phong = phong;
  surface.reflectance = vec3(0.0f);
  surface.transmittance = vec3(0.0f);
  surface.ior = 1.0f;
  surface.fresnel = false;
  return surface;
}

SHARED float shininess_of(float roughness) {
  float r2 = roughness * roughness;
  return clamp(0.25f * (2.0f / max(r2 * r2, 1e-8f) - 2.0f), 1.0f, 10000.0f);
}

SHARED PhongSurface phong_from_metallic_roughness(MetallicRoughness s) {
  PhongParams black;
  black.ambient = vec3(0.0f);
  black.diffuse = vec3(0.0f);
  black.specular = vec3(0.0f);
  black.shininess = 1.0f;
  black.emission = s.emissive;
  PhongSurface m = phong_surface(black);
  if (s.unlit) {
    m.phong.emission = s.base_color;
    return m;
  }
  float root = (s.ior - 1.0f) / (s.ior + 1.0f);
  vec3 dielectric_f0 = min(root * root * s.specular * s.specular_color, vec3(1.0f));
  vec3 f0 = mix(dielectric_f0, s.base_color, s.metallic);
  float opaque = (1.0f - s.metallic) * (1.0f - s.transmission);
  m.phong.ambient = s.base_color * (1.0f - s.transmission);
  m.phong.diffuse = s.base_color * (1.0f - largest_of(dielectric_f0)) * opaque * kOneByPi;
  m.phong.shininess = shininess_of(s.roughness);
  m.phong.specular = f0 * (m.phong.shininess + 2.0f) * (0.5f * kOneByPi);
  if (s.transmission > 0.0f && s.metallic < 1.0f) {
    m.transmittance = s.base_color * (s.transmission * (1.0f - s.metallic));
    m.ior = s.volume ? s.ior : 1.0f;
    return m;
  }
  float sharp = max(0.0f, 1.0f - s.roughness / kRoughestMirror);
  vec3 mirror = f0 * sharp * sharp;
  if (largest_of(mirror) > kLeastReflectance) {
    m.reflectance = mirror;
    m.fresnel = true;
  }
  return m;
}
