#include "pinocchio/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/math/finite.h"
#include "core/math/luminance.h"
#include "core/scene/sky/brightness.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The mean of what bilinear interpolation makes of a texel's area: of it and its neighbours, 1 6 1 each way.
double mean_light(const Image<glm::vec3>& image, int x, int y) {
  const glm::ivec2 size = image.size();
  double sum = 0.0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      const double share = (i == 0 ? 0.75 : 0.125) * (j == 0 ? 0.75 : 0.125);
      sum += share * luminance(image.at((x + i + size.x) % size.x, std::clamp(y + j, 0, size.y - 1)));
    }
  return sum;
}

// For each k, the first of `count` ends that grow to 1 above k / count (Chen and Asau 1974).
void find_guides(const float* ends, std::size_t count, std::uint32_t* guides) {
  std::uint32_t index = 0;
  for (std::size_t k = 0; k < count; ++k) {
    while (index + 1 < count && ends[index] * count <= k) ++index;
    guides[k] = index;
  }
}

// Environment::brightness()
template <class Words>
void pack_brightness(const Image<glm::vec3>& image, Words& words) {
  const int width = image.width(), height = image.height();
  float most = 0.0f;
  for (const glm::vec3& c : image.pixels()) most = std::max(most, luminance(c));
  std::vector<std::uint32_t> packed;
  packed.reserve(image.pixels().size());
  for (const glm::vec3& c : image.pixels())
    packed.push_back(packed_brightness(most > 0.0f ? luminance(c) / most : 0.0f));
  words.reserve(as_size(width) * (as_size(height) + 1));
  for (int y = 0; y <= height; ++y) {
    const std::uint32_t *const above = &packed[image.index(0, std::max(y - 1, 0))],
                               *const below = &packed[image.index(0, std::min(y, height - 1))];
    for (int x = 0; x < width; ++x) {
      const int right = x + 1 < width ? x + 1 : 0;
      words.push_back(above[x] | above[right] << 8 | below[x] << 16 | below[right] << 24);
    }
  }
}

// Sums so far, made to end with 1 (or all zero).
void make_to_one(const std::vector<double>& sums, float* ends) {
  const double whole = sums.back();
  for (std::size_t i = 0; i < sums.size(); ++i) ends[i] = whole > 0.0 ? as_float(sums[i] / whole) : 0.0f;
}

}  // namespace

Environment::Environment(Image<glm::vec3> radiance, std::string source)
    : radiance_(std::move(radiance)), source_(std::move(source)) {
  for (glm::vec3& c : radiance_.pixels()) c = is_finite(c) ? glm::max(c, 0.0f) : glm::vec3(0.0f);
  const std::size_t width = radiance_.width(), height = radiance_.height();
  rows_.resize(height);
  columns_.resize(width * height);
  std::vector<double> of_row(width), of_rows(height);
  double all = 0.0;
  for (std::size_t y = 0; y < height; ++y) {
    double sum = 0.0;
    for (std::size_t x = 0; x < width; ++x) of_row[x] = sum += mean_light(radiance_, as_int(x), as_int(y));
    make_to_one(of_row, &columns_[y * width]);
    const auto latitude = [&](std::size_t row) { return std::cos(glm::pi<double>() * row / height); };
    of_rows[y] = all += sum * (latitude(y) - latitude(y + 1));
  }
  make_to_one(of_rows, rows_.data());
  pack_brightness(radiance_, brightness_);
  row_guides_.resize(height);
  column_guides_.resize(width * height);
  find_guides(rows_.data(), height, row_guides_.data());
  for (std::size_t y = 0; y < height; ++y)
    find_guides(&columns_[y * width], width, &column_guides_[y * width]);
}

}  // namespace pinocchio
