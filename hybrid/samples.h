#pragma once

#include <functional>

#include "core/trace/shared.h"
#include "pinocchio/renderer.h"

namespace pinocchio {

// Which samples a frame takes of what is sampled.
[[nodiscard]] shared::Sampling sampling_of(const Settings& settings, const View& view);

// Submits as many frames as the settings have samples a pixel: the first at the pixels' centres, the others
// spread over them.
void submit_samples(Renderer& renderer, FrameRequest request);

// Brings frames to the CPU and hands on the mean of every `spp` of them.
class SampleMean {
 public:
  SampleMean(int spp, std::function<void(FrameResult&&)> done) : spp_(spp), done_(std::move(done)) {}

  void add(Frame& frame);

 private:
  int spp_;
  std::function<void(FrameResult&&)> done_;
  FrameResult sum_;  // of samples_ samples
  Image<glm::vec4> sample_;
  int samples_ = 0;
};

}  // namespace pinocchio
