#include "gl/objects/draw.h"

#include <algorithm>

#include "gl/context/context.h"
#include "gl/context/state.h"

namespace pinocchio::gl {

Mesh::Mesh(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles)
    : vertex_array_(make_vertex_array()),
      positions_(positions),
      indices_(triangles),
      index_count_(GLsizei(3 * triangles.size())) {
  glBindVertexArray(vertex_array_.name());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  glBindBuffer(GL_ARRAY_BUFFER, positions_.name());
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  glEnableVertexAttribArray(0);
  glBindVertexArray(0);
  throw_errors();
}

void Mesh::draw() const {
  glBindVertexArray(vertex_array_.name());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

void FullscreenTriangle::draw() const {
  if (!vertex_array_) vertex_array_ = make_vertex_array();
  glBindVertexArray(vertex_array_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void begin_depth_pass(const Framebuffer& target, std::uint32_t clear, glm::ivec2 picture_size,
                      glm::ivec2 first, bool fronts_only) {
  target.bind();
  // The viewport is the whole picture's, so that a part has the same rounding and the same pixels.
  set_viewport(-first, picture_size);
  set_raster_state({.depth = true, .fronts_only = fronts_only});
  const GLuint color[4] = {clear, clear, clear, clear};
  const GLfloat infinitely_far = 0.0f;
  glClearBufferuiv(GL_COLOR, 0, color);
  glClearBufferfv(GL_DEPTH, 0, &infinitely_far);
}

void begin_fullscreen_pass(const Framebuffer& target) {
  target.bind();
  set_raster_state({});
}

void begin_window_pass(glm::ivec2 window_pixels, glm::ivec2 lo, glm::ivec2 size) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  set_viewport({0, 0}, window_pixels);
  // The window's row 0 is at the bottom.
  set_raster_state({.srgb = false,
                    .scissor = true,
                    .scissor_box = {lo.x, window_pixels.y - lo.y - size.y, size.x, size.y}});
}

void end_window_pass() {
  set_raster_state({.srgb = false});
}

std::vector<glm::u8vec3> read_window(glm::ivec2 window_pixels) {
  const std::ptrdiff_t width = window_pixels.x, height = window_pixels.y;
  std::vector<glm::u8vec3> pixels(width * height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  set_pixel_store();
  glReadPixels(0, 0, window_pixels.x, window_pixels.y, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  for (std::ptrdiff_t y = 0; y < height / 2; ++y)
    std::swap_ranges(pixels.begin() + y * width, pixels.begin() + (y + 1) * width,
                     pixels.begin() + (height - 1 - y) * width);
  return pixels;
}

}  // namespace pinocchio::gl
