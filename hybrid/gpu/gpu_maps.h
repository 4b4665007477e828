#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/objects/program.h"
#include "gl/objects/texture.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// The buffers that shaders/map_fetch.glsl reads for a mesh whose materials have maps. For other meshes
// nothing is sent, and programs are compiled without that code.
class GpuMaps {
 public:
  // `shares_textures`: a mesh with the same textures, which are not sent again; null: none is known.
  explicit GpuMaps(const Mesh& mesh, const GpuMaps* shares_textures = nullptr);

  // Sends the tangents of these vertices again.
  void update_tangents(const Mesh& mesh, std::size_t first_vertex, std::size_t vertices);

  // Sets the buffers on texture units from `first_unit` on; returns the next free one.
  int bind(const gl::Program& program, int first_unit) const;
  // The definitions for programs that read the maps.
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
