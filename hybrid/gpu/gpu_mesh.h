#pragma once

#include <memory>

#include "gl/draw.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "hybrid/gpu/gpu_maps.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A mesh as the GPU's passes read it: triangles for the rasteriser, texture buffers for
// shaders/scene_fetch.glsl. Throws gl::Error where the GPU has no room.
class GpuMesh {
 public:
  // `shares_textures`: of another mesh that has the same textures; null: none is known.
  explicit GpuMesh(const Mesh& mesh, const GpuMesh* shares_textures = nullptr);

  void draw() const { triangles_.draw(); }
  // Gives the program in use the buffers, on texture units from `first_unit` on; returns the next free one.
  int bind(const gl::Program& program, int first_unit) const;

  [[nodiscard]] const GpuMaps& maps() const { return maps_; }
  [[nodiscard]] float z_near() const { return z_near_; }  // scene units

 private:
  gl::Mesh triangles_;
  gl::TextureBuffer corners_, triangle_materials_, positions_, normals_, materials_;
  GpuMaps maps_;
  float z_near_;
};

// A frame's lights, likewise.
class GpuLights {
 public:
  // Sends the scene's lights, unless they are the ones that are there.
  void update(const Scene& scene);
  int bind(const gl::Program& program, int first_unit) const;
  [[nodiscard]] bool any_size() const { return any_size_; }

 private:
  std::vector<Light> sent_;
  bool any_size_ = false;
  gl::TextureBuffer lights_;
  glm::vec3 ambient_light_{0.0f};
  bool empty_ = true;  // nothing was sent yet
};

}  // namespace pinocchio
