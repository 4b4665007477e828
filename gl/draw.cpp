#include "gl/draw.h"

#include <algorithm>

namespace pinocchio::gl {

Mesh::Mesh(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles)
    : vertex_array_(make_vertex_array()),
      positions_(positions),
      indices_(triangles),
      index_count_(static_cast<GLsizei>(3 * triangles.size())) {
  glBindVertexArray(vertex_array_.name());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  glBindBuffer(GL_ARRAY_BUFFER, positions_.name());
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  glEnableVertexAttribArray(0);
  glBindVertexArray(0);
}

void Mesh::draw() const {
  glBindVertexArray(vertex_array_.name());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

void FullscreenTriangle::draw() const {
  glBindVertexArray(vertex_array_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void begin_depth_pass(const Framebuffer& target, std::uint32_t clear, glm::ivec2 picture_size,
                      glm::ivec2 first) {
  target.bind();
  // The part is a window on the whole picture's viewport: same vertices, same rounding, same pixels.
  glViewport(-first.x, -first.y, picture_size.x, picture_size.y);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  const GLuint color[4] = {clear, clear, clear, clear};
  const GLfloat infinitely_far = 0.0f;
  glClearBufferuiv(GL_COLOR, 0, color);
  glClearBufferfv(GL_DEPTH, 0, &infinitely_far);
}

void begin_fullscreen_pass(const Framebuffer& target) {
  target.bind();
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_FRAMEBUFFER_SRGB);  // shaders write linear light, whatever the format
}

void begin_window_pass(glm::ivec2 window_pixels, glm::ivec2 lo, glm::ivec2 size) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, window_pixels.x, window_pixels.y);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_SCISSOR_TEST);
  glScissor(lo.x, window_pixels.y - lo.y - size.y, size.x, size.y);  // the window's row 0 is at the bottom
}

void end_window_pass() {
  glDisable(GL_SCISSOR_TEST);
}

std::vector<glm::u8vec3> read_window(glm::ivec2 window_pixels) {
  const auto width = static_cast<std::size_t>(window_pixels.x);
  const auto height = static_cast<std::size_t>(window_pixels.y);
  std::vector<glm::u8vec3> pixels(width * height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, window_pixels.x, window_pixels.y, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  for (std::size_t y = 0; y < height / 2; ++y)
    std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(y * width),
                     pixels.begin() + static_cast<std::ptrdiff_t>((y + 1) * width),
                     pixels.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * width));
  return pixels;
}

}  // namespace pinocchio::gl
