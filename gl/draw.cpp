#include "gl/draw.h"

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

}  // namespace pinocchio::gl
