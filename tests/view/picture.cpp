#include "tests/view/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <set>

#include "tests/support/stb_image.h"

namespace pinocchio {

Picture picture_of_file(const std::filesystem::path& file) {
  constexpr int kChannels = 3;
  int width = 0, height = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> bytes(
      stbi_load(file.c_str(), &width, &height, nullptr, kChannels), stbi_image_free);
  if (!bytes) return {};
  Picture picture({width, height});
  const stbi_uc* byte = bytes.get();
  for (glm::u8vec3& pixel : picture.pixels())
    for (int c = 0; c < kChannels; ++c) pixel[c] = *byte++;
  return picture;
}

Picture crop(const Picture& picture, const std::string& box) {
  glm::ivec2 size(0), corner(0);
  if (std::sscanf(box.c_str(), "%dx%d+%d+%d", &size.x, &size.y, &corner.x, &corner.y) != 4) std::abort();
  Picture cut(glm::clamp(picture.size() - corner, glm::ivec2(0), size));
  for (int y = 0; y < cut.height(); ++y)
    for (int x = 0; x < cut.width(); ++x) cut.at(x, y) = picture.at(corner.x + x, corner.y + y);
  return cut;
}

long long different_pixels(const Picture& a, const Picture& b, int percent) {
  if (a.empty() || a.size() != b.size()) return -1;
  long long count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const glm::ivec3 off = glm::abs(glm::ivec3(a[i]) - glm::ivec3(b[i]));
    if (100 * std::max({off.r, off.g, off.b}) > 255 * percent) ++count;
  }
  return count;
}

std::array<double, 3> mean_of(const Picture& picture) {
  glm::dvec3 sum(0.0);
  for (const glm::u8vec3& pixel : picture.pixels()) sum += glm::dvec3(pixel);
  sum /= 255.0 * static_cast<double>(picture.pixels().size());
  return {sum.r, sum.g, sum.b};
}

std::size_t count_colors(const Picture& picture) {
  std::set<std::array<unsigned char, 3>> colors;
  for (const glm::u8vec3& pixel : picture.pixels()) colors.insert({pixel.r, pixel.g, pixel.b});
  return colors.size();
}

std::vector<int> brightest_of_rows(const Picture& picture) {
  constexpr glm::dvec3 kLuma(0.2126, 0.7152, 0.0722);
  std::vector<int> rows(static_cast<std::size_t>(picture.height()));
  for (int y = 0; y < picture.height(); ++y) {
    int& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < picture.width(); ++x)
      row = std::max(row, static_cast<int>(std::lround(glm::dot(kLuma, glm::dvec3(picture.at(x, y))))));
  }
  return rows;
}

}  // namespace pinocchio
