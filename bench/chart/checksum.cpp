#include "bench/chart/checksum.h"

#include <boost/crc.hpp>
#include <type_traits>

namespace pinocchio::chart {
namespace {

class Checksum {
 public:
  // Values without padding.
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
  checksum.add(m.diffuse_texture);
}

void add_light(Checksum& checksum, const Light& l) {
  checksum.add(l.kind);
  for (const glm::vec3& v : {l.position, l.direction, l.color}) checksum.add(v);
  checksum.add(l.falloff);
  for (const float value : {l.intensity, l.range, l.cos_inner, l.cos_outer}) checksum.add(value);
  checksum.add(l.casts_shadow);
}

}  // namespace

std::uint32_t checksum_of(const Scene& scene) {
  Checksum checksum;
  checksum.add_all(scene.mesh->positions);
  checksum.add_all(scene.mesh->normals);
  checksum.add_all(scene.mesh->texcoords);
  checksum.add_all(scene.mesh->triangles);
  checksum.add_all(scene.mesh->triangle_materials);
  for (const Material& material : scene.mesh->materials) add_material(checksum, material);
  for (const Texture& texture : scene.mesh->textures) {
    checksum.add(texture.texels.size());
    checksum.add_all(texture.texels.pixels());
  }
  for (const Light& light : scene.lights) add_light(checksum, light);
  checksum.add(scene.ambient_light);
  return checksum.sum();
}

}  // namespace pinocchio::chart
