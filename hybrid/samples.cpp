#include "hybrid/samples.h"

#include "core/trace/jitter.h"

namespace pinocchio {

shared::Sampling sampling_of(const Settings& settings, const View& view) {
  return {static_cast<int>(settings.sequence.value), static_cast<std::uint32_t>(view.sample),
          static_cast<std::uint32_t>(settings.seed)};
}

void submit_samples(Renderer& renderer, FrameRequest request) {
  for (int k = 0; k < request.settings.spp; ++k) {
    request.view = at_sample(request.view, k);
    renderer.submit(request);
  }
}

void SampleMean::add(Frame& frame) {
  if (samples_ == 0) {
    sum_ = frame.read();
  } else {
    frame.read_color(sample_);
    for (std::size_t i = 0; i < sample_.pixels().size(); ++i) sum_.color[i] += sample_[i];
  }
  if (++samples_ < spp_) return;
  if (samples_ > 1)
    for (glm::vec4& pixel : sum_.color.pixels()) pixel /= static_cast<float>(samples_);
  samples_ = 0;
  done_(std::move(sum_));
}

}  // namespace pinocchio
