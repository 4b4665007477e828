#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/trace/trace_options.h"
#include "pinocchio/renderer.h"

namespace pinocchio {

// How a frame of these settings is traced and shaded. Textures are averaged over a sample's share of the
// pixel, as the samples themselves average, too.
[[nodiscard]] TraceOptions trace_options(const Settings& settings, const View& view);

// A scene's environment as the settings turn it, and no ambient light where that, or light from other
// surfaces, is sampled.
void settle_environment(Scene& scene, const Settings& settings);

class SampleMean;

// Submits as many frames as the settings have samples a pixel: the first at the pixels' centres, the others
// spread over them. Given the mean that they go to, and max_noise, no more than it wants.
void submit_samples(Renderer& renderer, FrameRequest request, SampleMean* mean = nullptr);

// Brings frames to the CPU and hands on the mean of every `spp` of them. With max_noise a tile whose mean is
// good enough takes no more samples: the standard error of its pixels' means, estimated from their samples,
// is below max_noise (root mean square over the tile and the colours). It is looked at every 16 samples.
// Which samples count is thus decided by all of a tile's pixels together, so that none can be left with few
// samples that agree by chance.
class SampleMean {
 public:
  SampleMean(const Settings& settings, std::function<void(FrameResult&&)> done)
      : spp_(settings.spp), max_noise_(settings.max_noise), done_(std::move(done)) {}

  void add(Frame& frame);

 private:
  friend void submit_samples(Renderer& renderer, FrameRequest request, SampleMean* mean);
  [[nodiscard]] bool is_adaptive() const { return max_noise_ > 0.0f && spp_ > 1; }
  void add_tiles(const FrameRequest& request);
  void look_at_tile(std::size_t tile);
  void finish();

  int spp_;
  float max_noise_;
  std::function<void(FrameResult&&)> done_;
  FrameResult sum_;  // of samples_ samples
  Image<glm::vec4> sample_;
  int samples_ = 0;
  // Of an adaptive picture:
  Image<glm::vec3> squares_;                                   // sum of the squared samples
  std::vector<int> tile_samples_;                              // that count, by tile
  std::shared_ptr<const std::vector<std::uint8_t>> finished_;  // tiles; null: none
};

}  // namespace pinocchio
