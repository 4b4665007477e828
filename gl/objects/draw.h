#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gl/objects/buffer.h"
#include "gl/objects/framebuffer.h"

namespace pinocchio::gl {

// Indexed triangles on the GPU: vertex attribute 0 is the position.
class Mesh {
 public:
  Mesh() = default;
  Mesh(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

  void draw() const;
  // Replaces those from `first` on.
  void write_positions(std::size_t first, std::span<const glm::vec3> positions) {
    positions_.write(first, positions);
  }
  void write_triangles(std::size_t first, std::span<const glm::uvec3> triangles) {
    indices_.write(first, triangles);
  }

 private:
  VertexArray vertex_array_;
  Buffer positions_, indices_;
  GLsizei index_count_ = 0;
};

// A triangle that covers the whole framebuffer. The vertex shader makes its corners from gl_VertexID.
class FullscreenTriangle {
 public:
  void draw() const;

 private:
  mutable VertexArray vertex_array_;  // made when first drawn
};

// Begins draws into `target` in which the nearest surface wins: reversed depth, 0 (infinitely far) to 1 (the
// near plane). Clears depth, and colour to the unsigned integers `clear`. `target` is the part of a picture
// of `picture_size` that starts at pixel `first`. fronts_only: triangles whose corners run
// clockwise in the picture are not drawn.
void begin_depth_pass(const Framebuffer& target, std::uint32_t clear, glm::ivec2 picture_size,
                      glm::ivec2 first, bool fronts_only = false);

// Begins draws into `target` without depth and without clearing: the draws write every pixel.
void begin_fullscreen_pass(const Framebuffer& target);

// Begins draws into the window, inside the box at `lo` (from the top left) of `size`. Shaders write the
// display's values.
void begin_window_pass(glm::ivec2 window_pixels, glm::ivec2 lo, glm::ivec2 size);
void end_window_pass();

// The window's pixels as drawn so far, before they are presented. Row 0 is the top row. Waits for the GPU.
[[nodiscard]] std::vector<glm::u8vec3> read_window(glm::ivec2 window_pixels);

}  // namespace pinocchio::gl
