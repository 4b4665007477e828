#include "hybrid/gpu/gpu_mesh.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "core/scene/pose/mesh_pose.h"
#include "core/shade/gltf_surface.h"
#include "core/shade/surface.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Layouts of shaders/scene_fetch.glsl.
struct MaterialTexels {
  glm::vec4 ambient_shininess, diffuse_maps, specular_alpha, emission_transmission, layer_grazing;
  LayerTexels layers;
};
struct LightTexels {
  glm::vec4 position_kind, direction_falloff, radiance_range, cone_slot, edge_u_size, edge_v;
};

std::vector<MaterialTexels> material_texels(const Mesh& mesh) {
  std::vector<MaterialTexels> texels;
  for (const Material& m : mesh.materials)
    texels.push_back({glm::vec4(m.ambient, m.shininess), glm::vec4(m.diffuse, as_float(m.maps + 1)),
                      glm::vec4(m.specular, m.ggx_alpha), glm::vec4(m.emission, m.layer.z),
                      glm::vec4(glm::vec2(m.layer), m.grazing,
                                (m.transmits() ? 1.0f : 0.0f) + (m.layers.any() ? 2.0f : 0.0f)),
                      layer_texels(m.layers)});
  return texels;
}

// One for each material: bit i says whether the camera sees through its backs with kBackfaces[i].
std::vector<std::uint32_t> back_texels(const Mesh& mesh) {
  std::vector<std::uint32_t> texels;
  for (const Material& m : mesh.materials) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kBackfaces.size(); ++i) bits |= passes_backs(m, kBackfaces[i]) ? 1u << i : 0u;
    texels.push_back(bits);
  }
  return texels;
}

std::array<GpuMesh::Share, kBackfaces.size()> shares_of_passed_backs(const Mesh& mesh) {
  const std::vector<std::uint32_t> texels = back_texels(mesh);
  std::uint32_t some = 0, all = ~0u;
  for (const std::uint32_t material : mesh.triangle_materials) {
    some |= texels[material];
    all &= texels[material];
  }
  std::array<GpuMesh::Share, kBackfaces.size()> shares{};
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i] = !(some >> i & 1u)  ? GpuMesh::Share::none
                : !(all >> i & 1u) ? GpuMesh::Share::some
                                   : GpuMesh::Share::all;
  return shares;
}

std::vector<LightTexels> light_texels(const Scene& scene) {
  std::vector<LightTexels> texels;
  const std::vector<int> slots = mask_slots(scene);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const shared::LightParams p = light_params(scene.lights[i]);
    const auto slot = as_float(slots[i]);
    texels.push_back({.position_kind = glm::vec4(p.position, as_float(p.kind)),
                      .direction_falloff = glm::vec4(p.direction, p.inverse_square ? 1.0f : 0.0f),
                      .radiance_range = glm::vec4(p.radiance, p.range),
                      .cone_slot = glm::vec4(p.cos_inner, p.cos_outer, slot, 0.0f),
                      .edge_u_size = glm::vec4(p.edge_u, p.size),
                      .edge_v = glm::vec4(p.edge_v, 0.0f)});
  }
  if (texels.empty()) texels.resize(1);  // a texture buffer cannot be empty
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

// Reversed float depth is as fine far away as near by, so the near plane may be almost 0: depth leaves
// float's normal numbers only beyond 2^66 diagonals.
float z_near_of(const Mesh& mesh) {
  return std::max(mesh.bounds().diagonal() * 0x1p-60f, std::numeric_limits<float>::min());
}

}  // namespace

GpuMesh::Geometry::Geometry(const Mesh& mesh)
    : triangles(mesh.positions, mesh.triangles),
      corners(unsigneds(mesh.triangles)),
      triangle_materials(unsigneds(mesh.triangle_materials)),
      positions(floats(mesh.positions)),
      normals(floats(mesh.normals)) {}

GpuMesh::GpuMesh(const Mesh& mesh, const Shared& shared)
    : geometry_(shared.geometry ? shared.geometry->geometry_ : std::make_shared<Geometry>(mesh)),
      materials_(quads(material_texels(mesh))),
      backs_(unsigneds(back_texels(mesh))),
      passed_backs_(shares_of_passed_backs(mesh)),
      maps_(mesh, shared.textures ? &shared.textures->maps_ : nullptr),
      z_near_(z_near_of(mesh)),
      bounds_(mesh.bounds()) {}

void GpuMesh::move(const MeshPose& before, const Mesh& now) {
  for (const NodePlace* const node : now.pose()->moved_since(before)) {
    const auto vertices = [node](const auto& of) {
      return std::span(of).subspan(node->first_vertex, node->vertices);
    };
    const auto triangles = std::span(now.triangles).subspan(node->first_triangle, node->triangles);
    geometry_->triangles.write_positions(node->first_vertex, vertices(now.positions));
    geometry_->positions.write(node->first_vertex, vertices(now.positions));
    geometry_->normals.write(node->first_vertex, vertices(now.normals));
    geometry_->triangles.write_triangles(node->first_triangle, triangles);
    geometry_->corners.write(node->first_triangle, triangles);
    maps_.update_tangents(now, node->first_vertex, node->vertices);
  }
  z_near_ = z_near_of(now);
  bounds_ = now.bounds();
}

bool are_poses_of_one(const Mesh& a, const Mesh& b) {
  return a.pose() && b.pose() && a.pose()->is_of_same_mesh(*b.pose());
}

bool has_same_geometry(const Mesh& a, const Mesh& b) {
  return a.positions == b.positions && a.normals == b.normals && a.triangles == b.triangles &&
         a.triangle_materials == b.triangle_materials;
}

int GpuMesh::bind(const gl::Program& program, int first_unit) const {
  int unit = first_unit;
  program.set("triangle_corners", unit++, geometry_->corners);
  program.set("triangle_materials", unit++, geometry_->triangle_materials);
  program.set("positions", unit++, geometry_->positions);
  program.set("normals", unit++, geometry_->normals);
  program.set("materials", unit++, materials_);
  return maps_.bind(program, unit);
}

int GpuMesh::bind_backs(const gl::Program& program, int first_unit) const {
  program.set("triangle_materials", first_unit, geometry_->triangle_materials);
  program.set("passed_backs", first_unit + 1, backs_);
  return first_unit + 2;
}

void GpuLights::update(const Scene& scene) {
  ambient_light_ = scene.ambient_light;
  if (!empty_ && sent_ == scene.lights) return;
  lights_ = quads(light_texels(scene));
  sent_ = scene.lights;
  any_size_ = std::ranges::any_of(sent_, &Light::has_size);
  casting_ = as_int(std::ranges::count_if(sent_, &Light::casts_shadow));
  empty_ = false;
}

int GpuLights::bind(const gl::Program& program, int first_unit) const {
  program.set("lights", first_unit, lights_);
  program.set("ambient_light", ambient_light_);
  program.set("light_count", as_int(sent_.size()));
  return first_unit + 1;
}

}  // namespace pinocchio
