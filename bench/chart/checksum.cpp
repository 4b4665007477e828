#include "bench/chart/checksum.h"

#include <boost/crc.hpp>
#include <type_traits>

namespace pinocchio::chart {
namespace {

class Checksum {
 public:
  // For values without padding.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(const T& value) { crc_.process_bytes(&value, sizeof value); }
  template <class Range>
  void add_all(const Range& values) {
    add(values.size());
    for (const auto& value : values) add(value);
  }
  [[nodiscard]] std::uint32_t sum() const { return crc_.checksum(); }

 private:
  boost::crc_32_type crc_;
};

void add_material(Checksum& checksum, const Material& m) {
  for (const glm::vec3& color :
       {m.ambient, m.diffuse, m.specular, m.reflectance, m.transmittance, m.emission})
    checksum.add(color);
  checksum.add(m.shininess);
  checksum.add(m.ior);
  checksum.add(m.fresnel);
  checksum.add(m.maps);
  if (m.gloss > 0.0f) checksum.add(m.gloss);
  if (!m.attenuates()) return;
  checksum.add(m.attenuation_color);
  checksum.add(m.attenuation_distance);
}

void add_use(Checksum& checksum, const TextureUse& use) {
  for (const int value :
       {use.texture, use.uv_set, static_cast<int>(use.wrap_u), static_cast<int>(use.wrap_v)})
    checksum.add(value);
  checksum.add(use.uv_from_texcoord);
  checksum.add(use.nearest);
}

void add_maps(Checksum& checksum, const MaterialMaps& m) {
  for (const TextureUse* use : m.uses()) add_use(checksum, *use);
  for (const bool flag : {m.vertex_colors, m.from_gltf, m.surface.volume, m.surface.unlit})
    checksum.add(flag);
  for (const glm::vec3& color : {m.surface.base_color, m.surface.emissive, m.surface.specular_color})
    checksum.add(color);
  for (const float value :
       {m.normal_scale, m.occlusion_strength, m.alpha_factor, m.alpha_cutoff, m.surface.metallic,
        m.surface.roughness, m.surface.ior, m.surface.specular, m.surface.transmission})
    checksum.add(value);
  checksum.add(m.alpha_channel);
  checksum.add(m.alpha_mode);
}

void add_light(Checksum& checksum, const Light& l) {
  checksum.add(l.kind);
  for (const glm::vec3& v : {l.position, l.direction, l.color}) checksum.add(v);
  checksum.add(l.falloff);
  for (const float value : {l.intensity, l.range, l.cos_inner, l.cos_outer}) checksum.add(value);
  checksum.add(l.casts_shadow);
  if (!l.has_size()) return;
  for (const float value : {l.radius, l.angle_deg}) checksum.add(value);
  for (const glm::vec3& v : {l.edge_u, l.edge_v}) checksum.add(v);
}

}  // namespace

std::uint32_t checksum_of(const Scene& scene) {
  Checksum checksum;
  checksum.add_all(scene.mesh->positions);
  checksum.add_all(scene.mesh->normals);
  checksum.add_all(scene.mesh->texcoords);
  checksum.add_all(scene.mesh->texcoords1);
  checksum.add_all(scene.mesh->colors);
  checksum.add_all(scene.mesh->tangents);
  checksum.add_all(scene.mesh->triangles);
  checksum.add_all(scene.mesh->triangle_materials);
  for (const Material& material : scene.mesh->materials) add_material(checksum, material);
  for (const MaterialMaps& maps : scene.mesh->maps) add_maps(checksum, maps);
  for (const Texture& texture : scene.mesh->textures) {
    checksum.add(texture.size());
    checksum.add_all(texture.image().pixels());
  }
  for (const Light& light : scene.lights) add_light(checksum, light);
  checksum.add(scene.ambient_light);
  if (scene.environment) checksum.add_all(scene.environment->radiance().pixels());
  return checksum.sum();
}

}  // namespace pinocchio::chart
