#include "core/reference/reference_environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Coordinates wrap around to the right, and are clamped downwards and upwards.
glm::ivec2 wrapped(glm::ivec2 at, glm::ivec2 size) {
  return {((at.x % size.x) + size.x) % size.x, std::clamp(at.y, 0, size.y - 1)};
}

// Finds the index in cumulative sums of a number in [0, 1) times the last sum, and the place between that sum
// and the one before.
struct Choice {
  std::size_t index;
  double within, share;  // share: the index's probability
};
Choice choice_of(const double* sums, std::size_t count, double number) {
  const double wanted = number * sums[count - 1];
  const auto index = std::min(as_size(std::upper_bound(sums, sums + count, wanted) - sums), count - 1);
  const double before = index == 0 ? 0.0 : sums[index - 1], own = sums[index] - before;
  return {index, (wanted - before) / own, own / sums[count - 1]};
}

}  // namespace

// A texel's weight is the brightest of it and its neighbours, whose light interpolation brings into its area.
ReferenceEnvironment::ReferenceEnvironment(const Environment& environment, double rotation_deg,
                                           double strength)
    : picture_(environment.radiance()), turn_(rotation_deg / 360.0), strength_(strength) {
  const glm::ivec2 size = picture_.size();
  double all = 0.0;
  for (int y = 0; y < size.y; ++y) {
    const double area =
        std::cos(std::numbers::pi * y / size.y) - std::cos(std::numbers::pi * (y + 1) / size.y);
    double row = 0.0;
    for (int x = 0; x < size.x; ++x) {
      double brightest = 0.0;
      for (int k = 0; k < 9; ++k) {
        const glm::ivec2 beside = wrapped(glm::ivec2(x + k % 3 - 1, y + k / 3 - 1), size);
        const glm::dvec3 c(picture_.at(beside.x, beside.y));
        brightest = std::max(brightest, c.x + c.y + c.z);
      }
      columns_.push_back(row += brightest);
    }
    rows_.push_back(all += area * row);
  }
}

glm::dvec3 ReferenceEnvironment::at(const glm::dvec2& uv) const {
  const glm::ivec2 size = picture_.size();
  const glm::dvec2 place = uv * glm::dvec2(size) - 0.5, base = glm::floor(place), f = place - base;
  glm::dvec3 sum(0.0);
  for (int k = 0; k < 4; ++k) {
    const glm::ivec2 offset(k % 2, k / 2), texel = wrapped(glm::ivec2(base) + offset, size);
    const double share = (offset.x ? f.x : 1.0 - f.x) * (offset.y ? f.y : 1.0 - f.y);
    sum += share * glm::dvec3(picture_.at(texel.x, texel.y));
  }
  return strength_ * sum;
}

// The picture's middle is +Z, a quarter of the width to its left is +X, the top row is +Y.
glm::dvec2 ReferenceEnvironment::place_of(const glm::dvec3& direction) const {
  const double around = std::atan2(direction.x, direction.z) / (2.0 * std::numbers::pi);
  const double down = std::atan2(std::hypot(direction.x, direction.z), direction.y) / std::numbers::pi;
  const double u = 0.5 - around + turn_;
  return {u - std::floor(u), down};
}

glm::dvec3 ReferenceEnvironment::radiance(const glm::dvec3& direction) const {
  return at(place_of(direction));
}

double ReferenceEnvironment::density(const glm::dvec3& direction) const {
  if (rows_.back() == 0.0) return 0.0;
  const glm::ivec2 size = picture_.size();
  const glm::dvec2 uv = place_of(direction);
  const glm::ivec2 texel = glm::min(glm::ivec2(uv * glm::dvec2(size)), size - 1);
  const auto share = [](const double* sums, int i, int count) {
    return (sums[i] - (i == 0 ? 0.0 : sums[i - 1])) / sums[count - 1];
  };
  const double per_uv = share(rows_.data(), texel.y, size.y) * size.y *
                        share(columns_.data() + std::size_t(texel.y) * size.x, texel.x, size.x) * size.x;
  return per_uv / (2.0 * std::numbers::pi * std::numbers::pi *
                   std::max(std::hypot(direction.x, direction.z) / glm::length(direction), 1e-12));
}

ReferenceEnvironment::Sample ReferenceEnvironment::sample(const glm::dvec2& numbers) const {
  const glm::ivec2 size = picture_.size();
  if (rows_.back() == 0.0) return {{0.0, 1.0, 0.0}, glm::dvec3(0.0), 0.0};
  const Choice row = choice_of(rows_.data(), rows_.size(), numbers.y);
  const Choice column = choice_of(columns_.data() + row.index * size.x, size.x, numbers.x);
  const glm::dvec2 uv =
      (glm::dvec2(column.index, row.index) + glm::dvec2(column.within, row.within)) / glm::dvec2(size);
  const double around = 2.0 * std::numbers::pi * (0.5 + turn_ - uv.x), down = std::numbers::pi * uv.y;
  const double per_uv = row.share * column.share * size.x * size.y;
  const double steradian =
      2.0 * std::numbers::pi * std::numbers::pi * std::sin(down);  // for a unit of u times v
  return {{std::sin(down) * std::sin(around), std::cos(down), std::sin(down) * std::cos(around)},
          steradian / per_uv * at(uv),
          per_uv / steradian};
}

}  // namespace pinocchio
