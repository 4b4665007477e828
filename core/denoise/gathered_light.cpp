#include "core/denoise/gathered_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/math/luminance.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr std::size_t kPlanes = 15;
constexpr int kLines = 8;              // a task
constexpr float kLeastAlbedo = 0.02f;  // that light of others than lamps is divided by
constexpr float kMostOfLamps = 10.0f;  // times their light without shadows
// GatheredLight::PartOfLight: standard deviations of the noise, squared, that count as x = 1 (lanes.h).
constexpr std::array<float, 2> kOfLuminance{8.0f, 2.0f};
constexpr float kMostLight =
    1e16f;  // that the filter takes: divided by an albedo and squared it stays finite

// Light that is no number, or beyond all bounds, would spread to other pixels.
glm::vec3 usable(const glm::vec3& light) {
  const auto is_usable = [](float c) { return std::abs(c) < kMostLight; };
  return is_usable(light.r) && is_usable(light.g) && is_usable(light.b) ? light : glm::vec3(0.0f);
}

bool is_surface(const SampledPoint& point) {
  return point.distance < kInfinity && glm::dot(point.normal, point.normal) < 1.1f &&
         glm::dot(point.albedo, point.albedo) < kMostLight &&
         glm::dot(point.lamp_albedo, point.lamp_albedo) < kMostLight;
}

// What light of others than lamps, or of lamps, is divided by. Both are of `samples` samples.
glm::vec3 divisor(bool of_lamps, const glm::vec3& light, const glm::vec3& albedo, float samples) {
  const glm::vec3 least =
      of_lamps ? glm::max(light / kMostOfLamps, glm::vec3(1e-12f)) : glm::vec3(kLeastAlbedo * samples);
  return glm::max(albedo, least);
}

template <class Body>
void for_each_line(int lines, Workers& workers, const Body& body) {
  workers.for_each(as_size((lines + kLines - 1) / kLines), [&](std::size_t i) {
    const int first = as_int(i) * kLines;
    for (int y = first; y < std::min(first + kLines, lines); ++y) body(y);
  });
}

}  // namespace

void GatheredLight::add(const Layers& sample, Picture picture, Isa isa, Workers& workers,
                        Image<glm::vec3>& light) {
  if (samples_ == 0) {
    size_ = sample[0]->size();
    for (Sums& sums : layers_) sums.clear();
  }
  if (light.size() != size_) light = Image<glm::vec3>(size_);
  std::ranges::fill(light.pixels(), glm::vec3(0.0f));
  ++samples_;
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    Sums& sums = layers_[k];
    if (sums.empty() && sample[k]->empty()) continue;
    sums.resize(light.pixels().size());
    if (!sample[k]->empty()) gather(*sample[k], sums, workers);
    if (picture == Picture::filtered) {
      for (const PartOfLight part : {kOthers, kLamps}) {
        fill_planes(sums, part, workers);
        filter(isa, workers);
        keep_filtered(part, sums, workers);
      }
    }
    add_shown(sums, picture, workers, light);
  }
}

void GatheredLight::keep_filtered(PartOfLight part, Sums& sums, Workers& workers) const {
  const auto width = as_size(size_.x);
  for_each_line(size_.y, workers, [&](int y) {
    for (std::size_t x = 0; x < width; ++x) {
      Sum& sum = sums[as_size(y) * width + x];
      Sum::Part& p = sum.parts[part];
      const std::ptrdiff_t at = y * stride_ + static_cast<std::ptrdiff_t>(x);
      const glm::vec3 filtered(now_.light[0][at], now_.light[1][at], now_.light[2][at]);
      p.filtered =
          sum.hits > 0.0f ? filtered * divisor(part == kLamps, p.light, p.albedo, sum.hits) : p.light;
    }
  });
}

// Adds what the layer's picture shows from now on, less what it has shown.
void GatheredLight::add_shown(Sums& sums, Picture picture, Workers& workers, Image<glm::vec3>& light) const {
  const auto width = as_size(size_.x);
  const auto count = as_float(samples_);
  for_each_line(size_.y, workers, [&](int y) {
    for (std::size_t i = as_size(y) * width; i < as_size(y + 1) * width; ++i) {
      Sum& sum = sums[i];
      const auto& [others, lamps] = sum.parts;
      const glm::vec3 all = picture == Picture::kept       ? sum.shown * (count / (count - 1.0f))
                            : picture == Picture::filtered ? others.filtered + lamps.filtered
                                                           : others.light + lamps.light;
      light[i] += all - sum.shown;
      sum.shown = all;
    }
  });
}

void GatheredLight::gather(const Image<SampledPoint>& sample, Sums& sums, Workers& workers) const {
  assert(sample.size() == size_);
  const auto width = as_size(size_.x);
  for_each_line(size_.y, workers, [&](int y) {
    for (std::size_t i = as_size(y) * width; i < as_size(y + 1) * width; ++i) {
      const SampledPoint& point = sample[i];
      Sum& sum = sums[i];
      const std::array lights{usable(point.light), usable(point.lamp_light)};
      for (std::size_t k = 0; k < kParts; ++k) sum.parts[k].light += lights[k];
      if (!is_surface(point)) continue;
      const std::array albedos{point.albedo, point.lamp_albedo};
      for (const PartOfLight k : {kOthers, kLamps}) {
        const float bare = luminance(lights[k] / divisor(k == kLamps, lights[k], albedos[k], 1.0f));
        sum.parts[k].albedo += albedos[k];
        sum.parts[k].first += bare;
        sum.parts[k].second += bare * bare;
      }
      if (sum.hits == 0.0f) {
        sum.normal = point.normal;
        sum.distance = point.distance;
        sum.guide_albedo = point.guide_albedo;
      }
      sum.hits += 1.0f;
    }
  });
}

float* GatheredLight::plane(std::size_t number) {
  const std::size_t lines = as_size(size_.y) + 2 * kDenoiseBorder;
  const auto stride = as_size(stride_);
  return planes_.data() + (number * lines + kDenoiseBorder) * stride + kDenoiseBorder;
}

// Means of the samples. Pixels that see nothing, and those around the picture, are infinitely far.
void GatheredLight::fill_planes(const Sums& sums, PartOfLight part, Workers& workers) {
  constexpr int kPacket = as_int(kCacheLine / sizeof(float));
  static_assert(kDenoiseBorder % kPacket == 0);
  stride_ = (size_.x + 2 * kDenoiseBorder + kPacket + kPacket - 1) / kPacket * kPacket;
  const std::size_t lines = as_size(size_.y) + 2 * kDenoiseBorder;
  const std::size_t floats = kPlanes * lines * as_size(stride_);
  // No plane may hold NaN: 0 times NaN is NaN.
  if (planes_.size() != floats) planes_.assign(floats, 0.0f);
  std::size_t used = 0;
  for (auto& channel : guides_.normal) channel = plane(used++);
  float* const normal[3] = {plane(0), plane(1), plane(2)};
  float* const distance = plane(used++);
  float* const albedo = plane(used++);
  for (DenoiseLight* const light : {&now_, &next_}) {
    for (float*& channel : light->light) channel = plane(used++);
    light->variance = plane(used++);
  }
  contrast_ = {plane(used), plane(used + 1)};
  assert(used + 2 == kPlanes);
  guides_.width = size_.x;
  guides_.stride = stride_;
  guides_.distance = distance;
  guides_.albedo = albedo;
  // One sample's noise is known from its surroundings alone, and less well.
  guides_.of_luminance = kOfLuminance[part] * (samples_ == 1 ? 2.0f : 1.0f);
  for_each_line(as_int(lines), workers, [&](int line) {
    float* const first = distance + (line - kDenoiseBorder) * stride_ - kDenoiseBorder;
    std::fill_n(first, stride_, kInfinity);
  });
  for_each_line(size_.y, workers, [&](int y) {
    for (int x = 0; x < size_.x; ++x) {
      const Sum& sum = sums[as_size(y) * as_size(size_.x) + x];
      const std::ptrdiff_t at = y * stride_ + x;
      const bool seen = sum.hits > 0.0f;
      const Sum::Part& p = sum.parts[part];
      const glm::vec3 of_surface = divisor(part == kLamps, p.light, p.albedo, sum.hits),
                      light = seen ? p.light / of_surface : glm::vec3(0.0f);
      const float mean = p.first / sum.hits;
      for (int c = 0; c < 3; ++c) {
        normal[c][at] = sum.normal[c];
        now_.light[c][at] = light[c];
      }
      albedo[at] = sum.guide_albedo;
      if (seen) distance[at] = sum.distance;
      // The variance of the mean.
      now_.variance[at] =
          sum.hits > 1.0f ? std::max(p.second / sum.hits - mean * mean, 0.0f) / (sum.hits - 1.0f) : 0.0f;
    }
  });
}

void GatheredLight::filter(Isa isa, Workers& workers) {
  const DenoiseSteps& steps = denoise_steps(isa);
  float* const variance = next_.variance;
  for_each_line(size_.y, workers,
                [&](int y) { steps.estimate(guides_, now_, samples_ == 1, y, variance, contrast_); });
  std::swap(now_.variance, next_.variance);
  for (int level = 0; level < kDenoiseLevels; ++level) {
    // One sample's luminance says little; later levels have their own.
    const DenoiseContrast* const contrast = level == 0 ? &contrast_ : nullptr;
    for_each_line(size_.y, workers,
                  [&](int y) { steps.filter(guides_, now_, contrast, next_, 1 << level, y); });
    std::swap(now_, next_);
  }
}

}  // namespace pinocchio
