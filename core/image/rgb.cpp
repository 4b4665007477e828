#include "core/image/rgb.h"

#include <algorithm>
#include <cmath>

namespace pinocchio {

Image<glm::vec3> rgb_of(const Image<glm::vec4>& picture) {
  Image<glm::vec3> rgb(picture.size());
  std::ranges::transform(picture.pixels(), rgb.pixels().begin(),
                         [](const glm::vec4& c) { return glm::vec3(c); });
  return rgb;
}

Image<glm::vec3> finite_rgb_of(const Image<glm::vec4>& picture) {
  Image<glm::vec3> rgb = rgb_of(picture);
  for (glm::vec3& pixel : rgb.pixels())
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(pixel[c])) pixel[c] = 0.0f;
  return rgb;
}

Image<glm::vec4> opaque(const Image<glm::vec3>& rgb) {
  Image<glm::vec4> picture(rgb.size());
  std::ranges::transform(rgb.pixels(), picture.pixels().begin(),
                         [](const glm::vec3& c) { return glm::vec4(c, 1.0f); });
  return picture;
}

}  // namespace pinocchio
