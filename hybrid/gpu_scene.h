#pragma once

#include "core/scene/scene.h"
#include "gl/draw.h"
#include "gl/program.h"
#include "gl/texture.h"

namespace pinocchio {

// The scene as the GPU's passes read it: triangles for the rasteriser, texture buffers for
// shaders/scene_fetch.glsl. Throws gl::Error where the GPU has no room.
class GpuScene {
 public:
  explicit GpuScene(const Scene& scene);

  void draw() const { mesh_.draw(); }
  // Gives the program in use the buffers and the lights, on texture units from `first_unit` on; returns the
  // next free one.
  int bind(const gl::Program& program, int first_unit) const;

  [[nodiscard]] bool textured() const { return textured_; }
  [[nodiscard]] float z_near() const { return z_near_; }  // scene units

 private:
  gl::Mesh mesh_;
  gl::TextureBuffer corners_, triangle_materials_, positions_, normals_, materials_, lights_;
  gl::TextureBuffer texcoords_, texels_;  // empty where nothing is textured
  glm::vec3 ambient_light_;
  int light_count_;
  bool textured_;
  float z_near_;
};

}  // namespace pinocchio
