#include "core/reference/reference_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/reference/reference_texture.h"

namespace pinocchio {
namespace {

glm::dvec3 scaled(const glm::vec3& a, const glm::dvec3& b) {
  return glm::dvec3(a) * b;
}

// `texel`: of a texture at the point, sRGB or not.
template <class Texel>
ReferenceLayers layers_of(const GltfLayers& l, const MaterialMaps& maps, const Texel& texel) {
  return {.coat = l.coat * texel(maps.clearcoat, false).r,
          .coat_roughness = l.coat_roughness * texel(maps.clearcoat_roughness, false).g,
          .sheen = scaled(l.sheen, glm::dvec3(texel(maps.sheen_color, true))),
          .sheen_roughness = l.sheen_roughness * texel(maps.sheen_roughness, false).a};
}

ReferenceMaterial as_it_stands(const Material& m) {
  return {glm::dvec3(m.ambient),
          glm::dvec3(m.diffuse),
          glm::dvec3(m.specular),
          glm::dvec3(m.emission),
          glm::dvec3(m.reflectance),
          glm::dvec3(m.transmittance),
          m.shininess,
          m.ior,
          m.fresnel,
          m.brdf,
          m.ggx_alpha,
          m.grazing,
          glm::dvec3(m.layer),
          m.gloss,
          layers_of(m.layers, {}, [](const TextureUse&, bool) { return glm::dvec4(1.0); })};
}

// A surface's textured values at a point.
struct PointSurface {
  glm::dvec3 base, emissive, specular_color;
  double strength, metallic, roughness, transmission;
  ReferenceLayers layers;
};

// How much of a mirror is left where no samples are taken.
double sharpness(double roughness) {
  return std::pow(std::max(0.0, 1.0 - roughness / 0.25), 2.0);
}

glm::dvec3 or_none(const glm::dvec3& mirror) {
  return std::max({mirror.x, mirror.y, mirror.z}) > 1.0 / 255.0 ? mirror : glm::dvec3(0.0);
}

// A metal's 8-bit map that is one step from 1 is no glass.
constexpr double kLeastTransmission = 1.5 / 255.0;

// docs/conventions.md, "Metallic-roughness".
ReferenceMaterial material_of(const GltfSurface& s, const PointSurface& at, bool phong) {
  const auto& [base, emissive, specular_color, strength, metallic, roughness, transmission, layers] = at;
  ReferenceMaterial m{};
  m.brdf = true;
  m.shininess = m.ior = 1.0;
  m.emission = s.unlit ? base : emissive;
  if (s.unlit) return m;
  const double n = s.ior;
  const glm::dvec3 dielectric =
      strength * glm::min(std::pow((n - 1.0) / (n + 1.0), 2.0) * specular_color, glm::dvec3(1.0));
  const glm::dvec3 f0 = (1.0 - metallic) * dielectric + metallic * base;
  const double most = std::max({dielectric.x, dielectric.y, dielectric.z});
  m.ambient = (1.0 - transmission) * base;
  m.diffuse = (1.0 - most) * (1.0 - metallic) * (1.0 - transmission) / std::numbers::pi * base;
  m.shininess = std::clamp((2.0 / std::max(std::pow(roughness, 4.0), 1e-8) - 2.0) / 4.0, 1.0, 10000.0);
  m.specular = (m.shininess + 2.0) / (2.0 * std::numbers::pi) * f0;
  if (!phong) {
    m.diffuse /= std::max(1.0 - most, 1e-9);
    m.specular = f0;
    m.ggx_alpha = squared_roughness(roughness, 0.0005);
    const double f90 = std::min(strength, 1.0);
    m.grazing = f90 + (1.0 - f90) * metallic;
    m.layer = {most, f90, transmission};
  }
  const bool glass = transmission * (1.0 - metallic) > kLeastTransmission;
  if (glass) {
    m.transmittance = (1.0 - metallic) * transmission * base;
    if (s.volume) m.ior = n;
  }
  if (m.transmits()) return m;
  if (!glass) m.reflectance = or_none(sharpness(roughness) * f0);
  if (!phong) {
    m.layers = layers;
    const double of_coat = 0.04 * layers.coat;
    m.reflectance =
        or_none((1.0 - of_coat) * m.reflectance + glm::dvec3(of_coat * sharpness(layers.coat_roughness)));
  }
  m.fresnel = m.reflects();
  return m;
}

glm::dvec4 vertex_color(const Mesh& mesh, const ReferenceHit& hit) {
  if (mesh.colors.empty()) return glm::dvec4(1.0);
  const glm::uvec3& t = mesh.triangles[hit.triangle];
  return hit.weights.x * glm::dvec4(mesh.colors[t.x]) + hit.weights.y * glm::dvec4(mesh.colors[t.y]) +
         hit.weights.z * glm::dvec4(mesh.colors[t.z]);
}

glm::dvec3 normal_of(const Mesh& mesh, const ReferenceHit& hit, const MaterialMaps& maps,
                     const ReferenceSpread& spread, const glm::dvec3& n) {
  const ReferenceTexture map(mesh, hit, maps.normal);
  if (!map.there()) return n;
  glm::dvec3 along_u(0.0), against_v(0.0);
  const glm::uvec3& t = mesh.triangles[hit.triangle];
  const glm::dvec4 given = mesh.tangents.empty() ? glm::dvec4(0.0)
                                                 : hit.weights.x * glm::dvec4(mesh.tangents[t.x]) +
                                                       hit.weights.y * glm::dvec4(mesh.tangents[t.y]) +
                                                       hit.weights.z * glm::dvec4(mesh.tangents[t.z]);
  if (given.w != 0.0) {
    along_u = glm::dvec3(given);
    against_v = (given.w < 0.0 ? -1.0 : 1.0) * glm::cross(n, along_u);
  } else {
    const glm::dmat2x3 p_by_uv = map.point_by_texcoord();
    along_u = p_by_uv[0];
    against_v = -p_by_uv[1];
  }
  along_u -= n * glm::dot(n, along_u);
  if (glm::dot(along_u, along_u) == 0.0) return n;
  along_u = glm::normalize(along_u);
  glm::dvec3 bitangent = glm::cross(n, along_u);
  if (glm::dot(bitangent, against_v) < 0.0) bitangent = -bitangent;
  const glm::dvec3 texel = 2.0 * glm::dvec3(map.mean(spread, false)) - 1.0;
  const double scale = maps.normal_scale;
  const glm::dvec3 turned = scale * texel.x * along_u + scale * texel.y * bitangent + texel.z * n;
  return glm::dot(turned, turned) > 1e-12 ? glm::normalize(turned) : n;
}

}  // namespace

double reference_alpha(const Mesh& mesh, const ReferenceHit& hit) {
  const MaterialMaps* const maps = mesh.maps_of(hit.triangle);
  if (!maps || maps->alpha_mode == AlphaMode::opaque) return 1.0;
  double alpha = maps->alpha_factor;
  alpha *= ReferenceTexture(mesh, hit, maps->alpha).at_point(false)[maps->alpha_channel];
  if (maps->vertex_colors) alpha *= vertex_color(mesh, hit).a;
  return alpha;
}

bool reference_hole(const Mesh& mesh, const ReferenceHit& hit) {
  const MaterialMaps* const maps = mesh.maps_of(hit.triangle);
  if (!maps || maps->alpha_mode == AlphaMode::opaque) return false;
  const double alpha = reference_alpha(mesh, hit);
  return maps->alpha_mode == AlphaMode::mask ? alpha < maps->alpha_cutoff : alpha <= 0.0;
}

ReferenceMaterial reference_material(const Mesh& mesh, const ReferenceHit& hit, const ReferenceSpread& spread,
                                     glm::dvec3& n_shading) {
  const Material& plain = mesh.material_of(hit.triangle);
  const MaterialMaps* const maps = mesh.maps_of(hit.triangle);
  if (!maps) return as_it_stands(plain);
  const auto texel = [&](const TextureUse& use, bool is_color) {
    return ReferenceTexture(mesh, hit, use).mean(spread, is_color);
  };
  glm::dvec3 base(texel(maps->base_color, true));
  if (maps->vertex_colors) base *= glm::dvec3(vertex_color(mesh, hit));
  const glm::dvec3 emissive(texel(maps->emissive, true));
  const double strength = maps->occlusion_strength;
  const double occlusion = (1.0 - strength) + strength * texel(maps->occlusion, false).r;

  ReferenceMaterial m;
  if (maps->from_gltf) {
    const glm::dvec4 rough_metal = texel(maps->metallic_roughness, false);
    const GltfSurface& s = maps->surface;
    const double specular = s.specular * texel(maps->specular, false).a;
    m = material_of(s,
                    {scaled(s.base_color, base), scaled(s.emissive, emissive),
                     scaled(s.specular_color, glm::dvec3(texel(maps->specular_color, true))), specular,
                     s.metallic * rough_metal.b, s.roughness * rough_metal.g,
                     s.transmission * texel(maps->transmission, false).r, layers_of(s.layers, *maps, texel)},
                    !plain.is_microfacet());
    m.coat_is_mapped = maps->coat_is_mapped;
  } else {
    m = as_it_stands(plain);
    m.ambient *= base;
    m.diffuse *= base;
    m.emission *= emissive;
  }
  m.ambient *= occlusion;
  n_shading = normal_of(mesh, hit, *maps, spread, n_shading);
  if (maps->alpha_mode == AlphaMode::blend) m.alpha = std::clamp(reference_alpha(mesh, hit), 0.0, 1.0);
  return m;
}

}  // namespace pinocchio
