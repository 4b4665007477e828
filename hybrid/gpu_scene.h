#pragma once

#include <memory>

#include "core/scene/scene.h"
#include "gl/draw.h"
#include "gl/program.h"
#include "gl/texture.h"

namespace pinocchio {

// The scene as the GPU's passes read it: triangles for the rasteriser, texture buffers for
// shaders/scene_fetch.glsl. Copies share all but the lights. Throws gl::Error where the GPU has no room.
class GpuScene {
 public:
  explicit GpuScene(const Scene& scene);

  // Takes the scene's lights anew.
  void relight(const Scene& scene);

  void draw() const { shared_->mesh.draw(); }
  // Gives the program in use the buffers and the lights, on texture units from `first_unit` on; returns the
  // next free one.
  int bind(const gl::Program& program, int first_unit) const;

  [[nodiscard]] bool textured() const { return textured_; }
  [[nodiscard]] float z_near() const { return z_near_; }  // scene units

 private:
  struct Shared {
    explicit Shared(const Scene& scene);
    gl::Mesh mesh;
    gl::TextureBuffer corners, triangle_materials, positions, normals, materials;
    gl::TextureBuffer texcoords, texels;  // empty where nothing is textured
  };

  std::shared_ptr<const Shared> shared_;
  std::shared_ptr<const gl::TextureBuffer> lights_;
  glm::vec3 ambient_light_;
  int light_count_ = 0;
  bool textured_;
  float z_near_;
};

}  // namespace pinocchio
