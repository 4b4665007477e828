// The sampled light of a picture's samples, and its filter.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/aligned_vector.h"
#include "core/denoise/denoise_steps.h"
#include "core/denoise/sampled_point.h"
#include "core/parallel/workers.h"
#include "pinocchio/image.h"

namespace pinocchio {

// Gathers a picture's samples one after the other and filters their mean. Light is divided by what the
// surface returns before it is filtered, and multiplied by it afterwards, so that textures stay sharp. The
// same bits for any number of threads and any instruction set.
class GatheredLight {
 public:
  // What the mean of the pictures shows after a sample: the samples' mean, that mean filtered, or what it
  // showed before.
  enum class Picture { mean, filtered, kept };
  // The layers of a sample, which are filtered one by one: what the camera sees, and what it sees in sharp
  // mirrors and through glass. Empty: there is none.
  using Layers = std::array<const Image<SampledPoint>*, 2>;
  // Adds a sample of the same size as the others. `light` becomes the light that its picture has in place of
  // the sampled one, so that the mean of this and all former pictures shows that. It may be below zero.
  void add(const Layers& sample, Picture picture, Isa isa, Workers& workers, Image<glm::vec3>& light);
  // Forgets the samples.
  void reset() { samples_ = 0; }
  // Forgets the samples and frees their memory.
  void release() { *this = {}; }
  [[nodiscard]] int samples() const { return samples_; }

 private:
  // Light of lights with a size is filtered by itself: its shadows have edges, and its noise is less.
  enum PartOfLight : std::size_t { kOthers, kLamps, kParts };
  // Sums over the samples that hit something, and the surface that the first of them hit: means over several
  // surfaces would be like none of them, and the edges' pixels keep their noise.
  struct Sum {
    struct Part {
      glm::vec3 light, albedo, filtered;
      float first, second;  // moments of the luminance divided by the albedo's
    };
    std::array<Part, kParts> parts;
    float hits;
    glm::vec3 shown;  // sum of all `light`
    glm::vec3 normal;
    float distance, guide_albedo;
  };
  using Sums = std::vector<Sum>;
  void gather(const Image<SampledPoint>& sample, Sums& sums, Workers& workers) const;
  void add_shown(Sums& sums, Picture picture, Workers& workers, Image<glm::vec3>& light) const;
  void fill_planes(const Sums& sums, PartOfLight part, Workers& workers);
  void keep_filtered(PartOfLight part, Sums& sums, Workers& workers) const;
  void filter(Isa isa, Workers& workers);
  [[nodiscard]] float* plane(std::size_t number);

  int samples_ = 0;
  glm::ivec2 size_{0};
  std::array<Sums, 2> layers_;  // of each one; empty: no sample had it
  std::ptrdiff_t stride_ = 0;
  AlignedVector<float> planes_;
  DenoiseGuides guides_;
  DenoiseLight now_, next_;
  DenoiseContrast contrast_;
};

}  // namespace pinocchio
