#include "core/compare/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Constants and names are from "FLIP: A Difference Evaluator for Alternating Images" (HPG 2020).
constexpr float kQc = 0.7f;   // compresses large colour differences
constexpr float kPc = 0.4f;   // share of the largest colour difference ...
constexpr float kPt = 0.95f;  // ... that is mapped to this error
constexpr float kQf = 0.5f;   // lifts small feature differences
constexpr double kFeatureDegrees = 0.082;

// Four planes are filtered at once, each with its own weights.
using Planes = Image<glm::vec4>;
using Kernel = std::vector<glm::vec4>;  // of odd length; the middle is the pixel itself

const glm::mat3 kXyzOfRgb =
    glm::transpose(glm::mat3(10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0,
                             2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0,
                             1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0));
const glm::mat3 kRgbOfXyz = glm::inverse(kXyzOfRgb);
const glm::vec3 kWhite = kXyzOfRgb * glm::vec3(1.0f);

// Linear opponent colours of XYZ relative to white.
glm::vec3 ycxcz(const glm::vec3& xyz) {
  return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}

glm::vec3 rgb_of_ycxcz(const glm::vec3& c) {
  const float y = (c.x + 16.0f) / 116.0f;
  return kRgbOfXyz * (kWhite * glm::vec3(y + c.y / 500.0f, y, y - c.z / 200.0f));
}

// CIELAB of linear RGB in [0, 1], with the chroma weighted by lightness (the Hunt effect).
glm::vec3 hunt_lab(const glm::vec3& rgb) {
  constexpr float kDelta = 6.0f / 29.0f;
  glm::vec3 f = kXyzOfRgb * rgb / kWhite;
  for (int c = 0; c < 3; ++c)
    f[c] = f[c] > kDelta * kDelta * kDelta ? std::cbrt(f[c]) : f[c] / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
  const float lightness = 116.0f * f.y - 16.0f;
  const float hunt = 0.01f * lightness;
  return {lightness, hunt * 500.0f * (f.x - f.y), hunt * 200.0f * (f.y - f.z)};
}

float hyab(const glm::vec3& a, const glm::vec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// The eye's contrast sensitivity: a Gaussian each for Y and Cx, and the sum of two for Cz. The sum is not
// separable, so its Gaussians have a plane each and are added after filtering.
Kernel contrast_kernel(double pixels_per_degree) {
  constexpr double kPi2 = std::numbers::pi * std::numbers::pi;
  constexpr std::array<double, 4> kWidth{0.0047, 0.0053, 0.04, 0.025};
  // Amplitudes in one dimension: the paper's a * sqrt(pi / b) is the product of two.
  const std::array<double, 4> amplitude{1.0, 1.0, std::sqrt(34.1 * std::sqrt(std::numbers::pi / 0.04)),
                                        std::sqrt(13.5 * std::sqrt(std::numbers::pi / 0.025))};
  const int radius = std::ceil(3.0 * std::sqrt(0.04 / (2.0 * kPi2)) * pixels_per_degree);
  std::vector<glm::dvec4> weights;
  glm::dvec4 sum(0.0);
  for (int x = -radius; x <= radius; ++x) {
    const double degrees = x / pixels_per_degree;
    glm::dvec4& w = weights.emplace_back(0.0);
    for (int c = 0; c < 4; ++c) {
      const auto i = as_size(c);
      w[c] = amplitude[i] * std::exp(-kPi2 * degrees * degrees / kWidth[i]);
    }
    sum += w;
  }
  sum.z = sum.w = std::hypot(sum.z, sum.w);
  Kernel kernel;
  for (const glm::dvec4& w : weights) kernel.emplace_back(w / sum);
  return kernel;
}

struct FeatureWeight {
  float gaussian, edge, point;  // edge, point: first and second derivative
};

// The weights on each side of a derivative add up to one, whatever the sampling.
std::vector<FeatureWeight> feature_weights(double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureDegrees * pixels_per_degree;
  const int radius = std::ceil(3.0 * sigma);
  std::vector<glm::dvec3> weights;
  glm::dvec3 positive(0.0), negative(0.0);
  for (int x = -radius; x <= radius; ++x) {
    const double u = x / sigma, g = std::exp(-0.5 * u * u);
    const glm::dvec3 w(g, -x * g, (u * u - 1.0) * g);
    positive += glm::max(w, 0.0);
    negative -= glm::min(w, 0.0);
    weights.push_back(w);
  }
  std::vector<FeatureWeight> result;
  for (const glm::dvec3& w : weights) {
    const auto scaled = [&](int c) {
      return as_float(w[c] / (w[c] > 0.0 ? positive[c] : std::max(negative[c], 1e-300)));
    };
    result.push_back({scaled(0), scaled(1), scaled(2)});
  }
  return result;
}

// Rows of a picture, in parallel.
struct Rows {
  Workers& workers;
  const Progress* progress;

  template <class Body>
  void for_each(int height, const Body& body) const {
    workers.for_each(height, [&](std::size_t row) {
      throw_if_cancelled(progress);
      body(row);
    });
  }
};

// Filters along rows (step (1, 0)) or columns ((0, 1)). The border's pixels continue beyond it.
Planes filtered(const Planes& in, const Kernel& kernel, glm::ivec2 step, const Rows& rows) {
  const int radius = kernel.size() / 2;
  const glm::ivec2 last = in.size() - 1;
  Planes out(in.size());
  rows.for_each(in.height(), [&](std::size_t row) {
    const int y = row;
    for (int x = 0; x < in.width(); ++x) {
      glm::vec4 sum(0.0f);
      for (int i = -radius; i <= radius; ++i) {
        const int from_x = std::clamp(x + i * step.x, 0, last.x);
        const int from_y = std::clamp(y + i * step.y, 0, last.y);
        sum += kernel[i + radius] * in.at(from_x, from_y);
      }
      out.at(x, y) = sum;
    }
  });
  return out;
}

Planes each_pixel(const Image<glm::vec3>& in, const Rows& rows, glm::vec4 (*value)(const glm::vec3&)) {
  Planes out(in.size());
  const auto width = as_size(in.width());
  rows.for_each(in.height(), [&](std::size_t row) {
    for (std::size_t i = row * width; i < (row + 1) * width; ++i)
      out[i] = value(glm::clamp(in[i], 0.0f, 1.0f));
  });
  return out;
}

// The picture as the eye resolves it, in rgb: (Y, Cx, Cz, Cz) filtered by the contrast kernel.
Planes seen(const Image<glm::vec3>& image, const Kernel& kernel, const Rows& rows) {
  const Planes opponent = each_pixel(image, rows, [](const glm::vec3& rgb) {
    const glm::vec3 c = ycxcz(kXyzOfRgb * rgb / kWhite);
    return glm::vec4(c, c.z);
  });
  return filtered(filtered(opponent, kernel, {1, 0}, rows), kernel, {0, 1}, rows);
}

// Colour of a pixel of seen() in FLIP's space, which Hunt's effect bends.
glm::vec3 lab_of_seen(const glm::vec4& c) {
  return hunt_lab(glm::clamp(rgb_of_ycxcz({c.x, c.y, c.z + c.w}), 0.0f, 1.0f));
}

// Edges and points of the luminance: (d/dx, d2/dx2, d/dy, d2/dy2).
Planes features(const Image<glm::vec3>& image, const std::vector<FeatureWeight>& weights, const Rows& rows) {
  Kernel across, down;
  for (const FeatureWeight& w : weights) {
    across.emplace_back(w.edge, w.point, w.gaussian, w.gaussian);
    down.emplace_back(w.gaussian, w.gaussian, w.edge, w.point);
  }
  const Planes luminance =
      each_pixel(image, rows, [](const glm::vec3& rgb) { return glm::vec4((kXyzOfRgb * rgb).y / kWhite.y); });
  return filtered(filtered(luminance, across, {1, 0}, rows), down, {0, 1}, rows);
}

float color_error(const glm::vec4& a, const glm::vec4& b) {
  static const float kLargest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kQc);
  const float knee = kPc * kLargest;
  const float difference = std::pow(hyab(lab_of_seen(a), lab_of_seen(b)), kQc);
  if (difference < knee) return difference * kPt / knee;
  return std::min(1.0f, kPt + (difference - knee) / (kLargest - knee) * (1.0f - kPt));
}

float feature_error(const glm::vec4& a, const glm::vec4& b) {
  const float edges = std::abs(std::hypot(a.x, a.z) - std::hypot(b.x, b.z));
  const float points = std::abs(std::hypot(a.y, a.w) - std::hypot(b.y, b.w));
  return std::pow(std::max(edges, points) * std::numbers::sqrt2_v<float> * 0.5f, kQf);
}

}  // namespace

Image<float> flip(const Image<glm::vec3>& a, const Image<glm::vec3>& b, float pixels_per_degree,
                  Workers& workers, Progress* progress) {
  assert(a.size() == b.size());
  assert(pixels_per_degree >= kLeastPixelsPerDegree && pixels_per_degree <= kMostPixelsPerDegree);
  Image<float> errors(a.size());
  const auto width = as_size(a.width());
  const Rows rows{workers, progress};
  const auto each = [&](const auto& body) {
    rows.for_each(a.height(), [&](std::size_t row) {
      for (std::size_t i = row * width; i < (row + 1) * width; ++i) body(i);
    });
  };
  {
    const Kernel kernel = contrast_kernel(pixels_per_degree);
    const Planes seen_a = seen(a, kernel, rows), seen_b = seen(b, kernel, rows);
    each([&](std::size_t i) { errors[i] = color_error(seen_a[i], seen_b[i]); });
  }
  const std::vector<FeatureWeight> weights = feature_weights(pixels_per_degree);
  const Planes features_a = features(a, weights, rows), features_b = features(b, weights, rows);
  each([&](std::size_t i) {
    errors[i] = std::pow(errors[i], 1.0f - feature_error(features_a[i], features_b[i]));
  });
  return errors;
}

double mean(const Image<float>& errors) {
  const auto values = errors.pixels();
  return std::accumulate(values.begin(), values.end(), 0.0) / std::max(1.0, as_double(values.size()));
}

}  // namespace pinocchio
