#include "core/scene/sky/blurred.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "core/scene/sky/lat_long.h"
#include "core/scene/sky/made_of.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using glm::pi;

constexpr int kWidest = 1024, kNarrowest = 64;  // of a blurred picture, texels
constexpr float kLeastWeight = 1e-5f;           // of a texel, where the middle's is 1: a sun leaves no edge

// The weights of a row's texels for a texel of another row, by their distance in columns, until they are
// negligible. The curve is von Mises and Fisher's: on a sphere, what a Gaussian is in a plane.
std::vector<float> weights_of(double theta, double other, double variance, int width) {
  std::vector<float> weights;
  const double across = std::sin(theta) * std::sin(other), along = std::cos(theta) * std::cos(other);
  for (int column = 0; column <= width / 2; ++column) {
    const double cosine = along + across * std::cos(2.0 * pi<double>() * column / width);
    const auto weight = as_float(std::exp((cosine - 1.0) / variance));
    if (weight < kLeastWeight) break;
    weights.push_back(weight);
  }
  return weights;
}

// Adds the row's light, weighted by the distance in columns, to `sums`. Returns the weights' sum.
float add_row(const glm::vec3* row, float area, const std::vector<float>& weights,
              std::vector<glm::vec3>& around, std::vector<glm::vec3>& sums) {
  const int width = as_int(sums.size()), reach = as_int(weights.size()) - 1;
  around.resize(as_size(width + 2 * reach));
  for (int i = 0; i < width + 2 * reach; ++i) around[as_size(i)] = row[(i - reach + width) % width];
  float all = 0.0f;
  const int last = std::min(reach, width - 1 - reach);  // so that no column counts twice
  for (int column = -reach; column <= last; ++column) {
    const float weight = area * weights[as_size(std::abs(column))];
    const glm::vec3* const from = around.data() + reach + column;
    for (int x = 0; x < width; ++x) sums[as_size(x)] += weight * from[x];
    all += weight;
  }
  return all;
}

Image<glm::vec3> spread(const Image<glm::vec3>& sky, double variance) {
  const int width = sky.width(), height = sky.height();
  const auto theta = [height](double row) { return pi<double>() * row / height; };
  Image<glm::vec3> result(sky.size());
  std::vector<glm::vec3> around, sums;
  for (int y = 0; y < height; ++y) {
    sums.assign(as_size(width), glm::vec3(0.0f));
    float all = 0.0f;
    for (int row = 0; row < height; ++row) {
      const std::vector<float> weights = weights_of(theta(y + 0.5), theta(row + 0.5), variance, width);
      if (weights.empty()) continue;
      const double area = std::cos(theta(row)) - std::cos(theta(row + 1.0));
      all += add_row(&sky.at(0, row), as_float(area), weights, around, sums);
    }
    for (int x = 0; x < width; ++x) result.at(x, y) = sums[as_size(x)] / all;
  }
  return result;
}

// An environment's blurred pictures.
struct Blurred {
  struct Picture {
    float deviation_deg;
    std::shared_ptr<const Environment> picture;
  };
  std::vector<Image<glm::vec3>> halves;  // each half as wide as the one before; the first: as the environment
  std::vector<Picture> newest;

  std::shared_ptr<const Environment> add(const Environment& environment, float deviation_deg);
};

// The picture's texels are half as wide as the deviation, so that wide blurs are quick.
std::shared_ptr<const Environment> Blurred::add(const Environment& environment, float deviation_deg) {
  const double deviation = glm::radians(as_double(deviation_deg));
  const double half_width = std::ceil(2.0 * pi<double>() / deviation);
  const int width = 2 * as_int(std::clamp(half_width, kNarrowest / 2.0, kWidest / 2.0));
  const auto last = [&]() -> const Image<glm::vec3>& {
    return halves.empty() ? environment.radiance() : halves.back();
  };
  while (last().width() > 2 * kNarrowest && last().height() > kNarrowest)
    halves.push_back(area_means(last(), last().size() / 2));
  const Image<glm::vec3>* from = &environment.radiance();
  for (const Image<glm::vec3>& half : halves)
    if (half.width() >= 2 * width) from = &half;
  // Texels and the interpolation between them blur, too.
  const double texel = 2.0 * pi<double>() / width;
  const double variance = std::max(deviation * deviation - 0.25 * texel * texel, 1e-9);
  const glm::ivec2 size(width, width / 2);
  const bool shrinks = size.x <= from->width() && size.y <= from->height();
  auto picture = std::make_shared<const Environment>(
      spread(shrinks ? area_means(*from, size) : reduced(*from, size), variance), environment.source());
  constexpr std::size_t kMost = 2;
  if (newest.size() == kMost) newest.erase(newest.begin());
  newest.push_back({deviation_deg, std::move(picture)});
  return newest.back().picture;
}

}  // namespace

std::shared_ptr<const Environment> blurred(const std::shared_ptr<const Environment>& environment,
                                           float deviation_deg) {
  if (!environment || deviation_deg <= 0.0f) return environment;
  static MadeOfEnvironments<Blurred> all;
  return all.with(environment, [&](Blurred& own) {
    for (const Blurred::Picture& b : own.newest)
      if (b.deviation_deg == deviation_deg) return b.picture;
    return own.add(*environment, deviation_deg);
  });
}

}  // namespace pinocchio
