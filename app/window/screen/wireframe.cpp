#include "app/window/screen/wireframe.h"

#include <algorithm>

namespace pinocchio::app {

const gl::Texture& Wireframe::draw(const Frame& frame) {
  FrameResult picture = frame.read();
  const glm::vec4 line(0.95f, 0.42f, 0.07f, 1.0f);
  const glm::ivec2 size = picture.color.size();
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const std::uint32_t id = picture.ids.at(x, y);
      const bool is_edge = id != picture.ids.at(std::min(x + 1, size.x - 1), y) ||
                           id != picture.ids.at(x, std::min(y + 1, size.y - 1));
      if (is_edge) picture.color.at(x, y) = line;
    }
  if (!texture_ || texture_->size() != size) texture_ = std::make_unique<gl::Texture>(size, gl::kRgba32F);
  upload_.send(std::as_bytes(picture.color.pixels()), *texture_);
  return *texture_;
}

}  // namespace pinocchio::app
