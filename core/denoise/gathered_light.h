// The sampled light of a picture's samples, and its filter.
#pragma once

#include <cstddef>
#include <vector>

#include "core/bsp/tree.h"
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
  // Adds a sample of the same size as the others. `light` becomes the light that its picture has in place of
  // the sampled one, so that the mean of this and all former pictures shows that. It may be below zero.
  void add(const Image<SampledPoint>& sample, Picture picture, Isa isa, Workers& workers,
           Image<glm::vec3>& light);
  // Forgets the samples.
  void reset() { samples_ = 0; }
  // Forgets the samples and frees their memory.
  void release() { *this = {}; }
  [[nodiscard]] int samples() const { return samples_; }

 private:
  // Sums over the samples that hit something, and the surface that the first of them hit: means over several
  // surfaces would be like none of them, and the edges' pixels keep their noise.
  struct Sum {
    glm::vec3 light, albedo;
    float hits, first, second;  // moments of the luminance divided by the albedo's
    glm::vec3 shown;            // sum of all `light`
    glm::vec3 normal;
    float distance, guide_albedo;
  };
  [[nodiscard]] static glm::vec3 returned(const Sum& sum);
  void gather(const Image<SampledPoint>& sample, Workers& workers);
  void fill_planes(Workers& workers);
  void filter(Isa isa, Workers& workers);
  [[nodiscard]] float* plane(std::size_t number);

  int samples_ = 0;
  glm::ivec2 size_{0};
  std::vector<Sum> sums_;
  std::ptrdiff_t stride_ = 0;
  AlignedVector<float> planes_;
  DenoiseGuides guides_;
  DenoiseLight now_, next_;
  DenoiseContrast contrast_;
};

}  // namespace pinocchio
