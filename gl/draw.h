#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/framebuffer.h"

namespace pinocchio::gl {

// Indexed triangles on the GPU: vertex attribute 0 is the position.
class Mesh {
 public:
  Mesh() = default;
  Mesh(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

  void draw() const;

 private:
  VertexArray vertex_array_;
  Buffer positions_, indices_;
  GLsizei index_count_ = 0;
};

// Draws a triangle that covers the whole framebuffer; the vertex shader makes its corners of gl_VertexID.
class FullscreenTriangle {
 public:
  void draw() const;

 private:
  mutable VertexArray vertex_array_;  // made when first drawn
};

// Draws into `target` begin here, nearest surface wins: reversed depth, 0 (infinitely far) to 1 (the near
// plane). Colour and depth are cleared, the colour to unsigned integers `clear`. `target` shows the
// part of a picture of `picture_size` that starts at pixel `first`.
void begin_depth_pass(const Framebuffer& target, std::uint32_t clear, glm::ivec2 picture_size,
                      glm::ivec2 first);

// Draws into `target` begin here, without depth; every pixel will be written.
void begin_fullscreen_pass(const Framebuffer& target);

// Draws into the window of `window_pixels` begin here, into the box at `lo` (from the top left) of `size`
// alone; shaders write what the display shows.
void begin_window_pass(glm::ivec2 window_pixels, glm::ivec2 lo, glm::ivec2 size);
void end_window_pass();

// The window's pixels as drawn so far, before they are presented; row 0 on top. Waits for the GPU.
[[nodiscard]] std::vector<glm::u8vec3> read_window(glm::ivec2 window_pixels);

}  // namespace pinocchio::gl
