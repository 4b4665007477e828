#include "core/scene/sky/prefiltered_sky.h"

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

// The direction of a place in the picture, as Environment has it.
glm::dvec3 direction_of(double u, double v) {
  const double down = pi<double>() * v, turn = 2.0 * pi<double>() * u;
  return {std::sin(down) * std::sin(turn), std::cos(down), -std::sin(down) * std::cos(turn)};
}

// Calls visit(direction, solid angle, light) for each texel.
template <class Visit>
void for_each_texel(const Image<glm::vec3>& picture, Visit visit) {
  const glm::dvec2 size(picture.size());
  for (int y = 0; y < picture.height(); ++y) {
    const double angle = 2.0 * pi<double>() / size.x *
                         (std::cos(pi<double>() * y / size.y) - std::cos(pi<double>() * (y + 1) / size.y));
    for (int x = 0; x < picture.width(); ++x)
      visit(direction_of((x + 0.5) / size.x, (y + 0.5) / size.y), angle, glm::dvec3(picture.at(x, y)));
  }
}

// Ramamoorthi and Hanrahan 2001: the light's coefficients, times those of the cosine, times the basis'
// constants, so that a sum of products with the polynomials is the irradiance.
std::array<glm::vec3, 9> irradiance_of(const Image<glm::vec3>& sky) {
  constexpr double kFlat = 0.282095, kLinear = 0.488603, kMixed = 1.092548, kZ = 0.315392, kXY = 0.546274;
  const double cosine[3] = {pi<double>(), 2.0 * pi<double>() / 3.0, pi<double>() / 4.0};
  std::array<glm::dvec3, 9> light{};
  constexpr std::array<double, 9> kBasis{kFlat, kLinear, kLinear, kLinear, kMixed, kMixed, kZ, kMixed, kXY};
  for_each_texel(sky, [&](const glm::dvec3& d, double angle, const glm::dvec3& from) {
    const std::array<double, 9> polynomial{
        1.0, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3.0 * d.z * d.z - 1.0, d.x * d.z, d.x * d.x - d.y * d.y};
    for (std::size_t i = 0; i < 9; ++i) light[i] += angle * kBasis[i] * polynomial[i] * from;
  });
  std::array<glm::vec3, 9> irradiance{};
  for (std::size_t i = 0; i < 9; ++i)
    irradiance[i] = glm::vec3(cosine[i == 0 ? 0 : i < 4 ? 1 : 2] * kBasis[i] * light[i]);
  return irradiance;
}

// What a mirror of that roughness sees that is looked at along its normal: the density of its facets, times
// the cosine (Karis 2013). Pairs of texels with the same rows and distance in longitude have the same weight.
Image<glm::vec3> seen_by(const Image<glm::vec3>& sky, float roughness, glm::ivec2 size) {
  const int width = sky.width(), height = sky.height(), finer = width / size.x;
  const double alpha2 = std::pow(as_double(roughness), 4.0);
  Image<glm::vec3> seen(size);
  std::vector<float> weights(as_size(width));
  for (int y = 0; y < size.y; ++y) {
    const double v = (y + 0.5) / size.y;
    const glm::dvec3 n = direction_of(0.5 * finer / width, v);  // of column 0
    std::vector<glm::vec3> sums(as_size(size.x), glm::vec3(0.0f));
    double all = 0.0;
    for (int row = 0; row < height; ++row) {
      const double angle =
          std::cos(pi<double>() * row / height) - std::cos(pi<double>() * (row + 1) / height);
      double of_row = 0.0;
      for (int column = 0; column < width; ++column) {
        const double n_dot_l = glm::dot(n, direction_of((column + 0.5) / width, (row + 0.5) / height));
        const double n_dot_h2 = 0.5 * (1.0 + n_dot_l);  // squared
        const double across = n_dot_h2 * (alpha2 - 1.0) + 1.0;
        const double weight = n_dot_l > 0.0 ? angle * n_dot_l / (across * across) : 0.0;
        weights[as_size(column)] = as_float(weight);
        of_row += weight;
      }
      all += of_row;
      if (of_row == 0.0) continue;
      for (int x = 0; x < size.x; ++x) {
        glm::vec3 sum(0.0f);
        for (int column = 0; column < width; ++column)
          sum += weights[as_size(column)] * sky.at((column + x * finer) % width, row);
        sums[as_size(x)] += sum;
      }
    }
    for (int x = 0; x < size.x; ++x) seen.at(x, y) = sums[as_size(x)] / as_float(std::max(all, 1e-30));
  }
  return seen;
}

}  // namespace

PrefilteredSky::PrefilteredSky(const Environment& environment) {
  const Image<glm::vec3> fine = reduced(environment.radiance(), {128, 64});
  const Image<glm::vec3> coarse = reduced(fine, {64, 32});
  irradiance = irradiance_of(fine);
  for (std::size_t i = 0; i < levels.size(); ++i)
    levels[i] = i == 0 ? seen_by(fine, kSkyRoughness[i], fine.size())
                       : seen_by(coarse, kSkyRoughness[i], coarse.size());
}

std::shared_ptr<const PrefilteredSky> prefiltered(const std::shared_ptr<const Environment>& environment) {
  static MadeOfEnvironments<std::shared_ptr<const PrefilteredSky>> skies;
  return skies.with(environment, [&](std::shared_ptr<const PrefilteredSky>& sky) {
    if (!sky) sky = std::make_shared<const PrefilteredSky>(*environment);
    return sky;
  });
}

}  // namespace pinocchio
