#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/program.h"
#include "gl/texture.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// What shaders/map_fetch.glsl reads of a mesh whose materials have maps; for others nothing is sent, and
// programs are compiled without it.
class GpuMaps {
 public:
  // `shares_textures`: of a mesh that has the same ones; null: none is known.
  explicit GpuMaps(const Mesh& mesh, const GpuMaps* shares_textures = nullptr);

  // The next free texture unit.
  int bind(const gl::Program& program, int first_unit) const;
  // What programs that read it are compiled with.
  [[nodiscard]] const std::vector<std::string>& definitions() const { return definitions_; }
  [[nodiscard]] bool has_holes() const { return has_holes_; }

 private:
  gl::TextureBuffer maps_, texcoords_, vertex_quads_;
  std::shared_ptr<const gl::TextureBuffer> texels_;
  int vertex_count_ = 0;
  std::vector<std::string> definitions_;
  bool has_holes_ = false;
};

}  // namespace pinocchio
