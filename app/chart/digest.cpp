#include "app/chart/digest.h"

#include <boost/crc.hpp>
#include <type_traits>

namespace pinocchio::app {
namespace {

class Digest {
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

void add_material(Digest& digest, const Material& m) {
  for (const glm::vec3& color :
       {m.ambient, m.diffuse, m.specular, m.reflectance, m.transmittance, m.emission})
    digest.add(color);
  digest.add(m.shininess);
  digest.add(m.ior);
  digest.add(m.fresnel);
  digest.add(m.diffuse_texture);
}

void add_light(Digest& digest, const Light& l) {
  digest.add(l.kind);
  for (const glm::vec3& v : {l.position, l.direction, l.color}) digest.add(v);
  digest.add(l.falloff);
  for (const float value : {l.intensity, l.range, l.cos_inner, l.cos_outer}) digest.add(value);
  digest.add(l.casts_shadow);
}

}  // namespace

std::uint32_t digest_of(const Scene& scene) {
  Digest digest;
  digest.add_all(scene.mesh->positions);
  digest.add_all(scene.mesh->normals);
  digest.add_all(scene.mesh->texcoords);
  digest.add_all(scene.mesh->triangles);
  digest.add_all(scene.mesh->triangle_materials);
  for (const Material& material : scene.mesh->materials) add_material(digest, material);
  for (const Texture& texture : scene.mesh->textures) {
    digest.add(texture.texels.size());
    digest.add_all(texture.texels.pixels());
  }
  for (const Light& light : scene.lights) add_light(digest, light);
  digest.add(scene.ambient_light);
  return digest.sum();
}

}  // namespace pinocchio::app
