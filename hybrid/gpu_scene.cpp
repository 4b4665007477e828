#include "hybrid/gpu_scene.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "core/trace/surface.h"

namespace pinocchio {
namespace {

// Layouts of shaders/scene_fetch.glsl.
struct MaterialTexels {
  glm::vec4 ambient_shininess, diffuse, specular, emission, texture_place;
};
struct LightTexels {
  glm::vec4 position_kind, direction_falloff, radiance_range, cone_slot;
};

// A texture's first texel is split over two floats, exact up to 2^24 each.
constexpr std::size_t kPlaceDigit = 4096;

std::vector<std::size_t> first_texels(const Scene& scene) {
  std::vector<std::size_t> first;
  std::size_t next = 0;
  for (const Texture& texture : scene.mesh->textures) {
    first.push_back(next);
    next += texture.texels.pixels().size();
  }
  return first;
}

std::vector<MaterialTexels> material_texels(const Scene& scene) {
  const std::vector<std::size_t> first = first_texels(scene);
  std::vector<MaterialTexels> texels;
  for (const Material& m : scene.mesh->materials) {
    MaterialTexels t{glm::vec4(m.ambient, m.shininess), glm::vec4(m.diffuse, 0.0f),
                     glm::vec4(m.specular, 0.0f), glm::vec4(m.emission, 0.0f), glm::vec4(0.0f)};
    if (m.diffuse_texture >= 0) {
      const auto i = static_cast<std::size_t>(m.diffuse_texture);
      const glm::ivec2 size = scene.mesh->textures[i].texels.size();
      t.texture_place = {static_cast<float>(first[i] / kPlaceDigit),
                         static_cast<float>(first[i] % kPlaceDigit), static_cast<float>(size.x),
                         static_cast<float>(size.y)};
    }
    texels.push_back(t);
  }
  return texels;
}

std::vector<LightTexels> light_texels(const Scene& scene) {
  std::vector<LightTexels> texels;
  const std::vector<int> slots = mask_slots(scene);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const shared::LightParams p = light_params(scene.lights[i]);
    const auto slot = static_cast<float>(slots[i]);
    texels.push_back({glm::vec4(p.position, static_cast<float>(p.kind)),
                      glm::vec4(p.direction, p.inverse_square ? 1.0f : 0.0f), glm::vec4(p.radiance, p.range),
                      glm::vec4(p.cos_inner, p.cos_outer, slot, 0.0f)});
  }
  if (texels.empty()) texels.resize(1);  // a texture buffer of no size is none
  return texels;
}

std::vector<glm::u8vec4> all_texels(const Scene& scene) {
  std::vector<glm::u8vec4> texels;
  for (const Texture& texture : scene.mesh->textures)
    texels.insert(texels.end(), texture.texels.pixels().begin(), texture.texels.pixels().end());
  return texels;
}

template <class T>
gl::TextureBuffer floats(const std::vector<T>& data) {
  return {std::span<const T>(data), GL_R32F, sizeof(float)};
}

template <class T>
gl::TextureBuffer quads(const std::vector<T>& data) {
  return {std::span<const T>(data), GL_RGBA32F, sizeof(glm::vec4)};
}

template <class T>
gl::TextureBuffer unsigneds(const std::vector<T>& data) {
  return {std::span<const T>(data), GL_R32UI, sizeof(std::uint32_t)};
}

bool has_textures(const Mesh& mesh) {
  const auto textured = [](const Material& m) { return m.diffuse_texture >= 0; };
  return !mesh.texcoords.empty() && std::any_of(mesh.materials.begin(), mesh.materials.end(), textured);
}

}  // namespace

GpuScene::Shared::Shared(const Scene& scene)
    : mesh(scene.mesh->positions, scene.mesh->triangles),
      corners(unsigneds(scene.mesh->triangles)),
      triangle_materials(unsigneds(scene.mesh->triangle_materials)),
      positions(floats(scene.mesh->positions)),
      normals(floats(scene.mesh->normals)),
      materials(quads(material_texels(scene))) {
  if (!has_textures(*scene.mesh)) return;
  texcoords = floats(scene.mesh->texcoords);
  texels = {std::span<const glm::u8vec4>(all_texels(scene)), GL_RGBA8, sizeof(glm::u8vec4)};
}

GpuScene::GpuScene(const Scene& scene)
    : shared_(std::make_shared<const Shared>(scene)),
      ambient_light_(scene.ambient_light),
      textured_(has_textures(*scene.mesh)),
      // Reversed float depth is as fine far away as near by, so the near plane may be next to nothing.
      z_near_(std::max(scene.mesh->bounds().diagonal() * 1e-6f, std::numeric_limits<float>::min())) {
  relight(scene);
}

void GpuScene::relight(const Scene& scene) {
  lights_ = std::make_shared<const gl::TextureBuffer>(quads(light_texels(scene)));
  light_count_ = static_cast<int>(scene.lights.size());
}

int GpuScene::bind(const gl::Program& program, int first_unit) const {
  int unit = first_unit;
  program.set("triangle_corners", unit++, shared_->corners);
  program.set("triangle_materials", unit++, shared_->triangle_materials);
  program.set("positions", unit++, shared_->positions);
  program.set("normals", unit++, shared_->normals);
  program.set("materials", unit++, shared_->materials);
  program.set("lights", unit++, *lights_);
  program.set("ambient_light", ambient_light_);
  program.set("light_count", light_count_);
  if (!textured_) return unit;
  program.set("texcoords", unit++, shared_->texcoords);
  program.set("texels", unit++, shared_->texels);
  return unit;
}

}  // namespace pinocchio
