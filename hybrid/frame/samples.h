#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/trace/rays/trace_options.h"
#include "pinocchio/renderer.h"

namespace pinocchio {

// The tracing options of a frame with these settings. Textures are averaged over a sample's share of the
// pixel: the samples average the rest.
[[nodiscard]] TraceOptions trace_options(const Settings& settings, const View& view);

// Rotates and scales the scene's environment as the settings say, and sets ambient light to 0 where the
// environment, or light from other surfaces, is sampled.
void settle_environment(Scene& scene, const Settings& settings);

// Whether the requests differ at most in where pixels are sampled.
[[nodiscard]] bool same_view(FrameRequest a, const FrameRequest& b);

// The bits a pixel of the frame's mask on the CPU, which has every casting light; 0: none.
[[nodiscard]] int mask_bits_of(const Settings& settings, const Scene& scene);
// Whether some casting lights are beyond the mask that goes to the GPU: the CPU adds theirs to the mirrored
// light.
[[nodiscard]] bool sends_lights(const Settings& settings, const Scene& scene);

// The colour behind the scene, which pictures for a screen show without exposure; none: it is no colour.
[[nodiscard]] std::optional<glm::vec3> color_behind(const Settings& settings);

class SampleMean;

// True if a picture may take fewer samples than spp (max_noise).
[[nodiscard]] inline bool is_adaptive(const Settings& settings) {
  return settings.max_noise > 0.0f && settings.spp > 1;
}

// Submits a frame for each sample a pixel: the first at the pixels' centres, the others spread over them.
// With max_noise and the mean that the frames go to, it ends as soon as all tiles are finished.
void submit_samples(Renderer& renderer, FrameRequest request, SampleMean* mean = nullptr);

// Brings frames to the CPU and passes on the mean of every `spp` of them. With max_noise a tile takes no more
// samples once the standard error of its pixels' means, estimated from their samples, is below max_noise
// (root mean square over the tile and the colours); that is checked every 16 samples. All pixels of a tile
// decide together, so that none ends early because its few samples agree by chance.
class SampleMean {
 public:
  SampleMean(const Settings& settings, std::function<void(FrameResult&&)> done)
      : spp_(settings.spp),
        is_adaptive_(pinocchio::is_adaptive(settings)),
        max_noise_(settings.max_noise),
        done_(std::move(done)) {}

  void add(Frame& frame);

 private:
  friend void submit_samples(Renderer& renderer, FrameRequest request, SampleMean* mean);
  void add_surfaces(const Frame& frame);
  void add_tiles(const FrameRequest& request, const Image<glm::vec4>& picture);
  void check_tile(std::size_t tile);
  void finish();

  int spp_;
  bool is_adaptive_;
  float max_noise_;
  std::function<void(FrameResult&&)> done_;
  FrameResult sum_;  // its colour is the sum of samples_ samples
  Image<glm::vec4> sample_;
  int samples_ = 0;
  // With max_noise:
  Image<glm::vec3> squares_;                                   // sum of the squared samples
  std::vector<int> tile_samples_;                              // samples of each tile
  std::shared_ptr<const std::vector<std::uint8_t>> finished_;  // by tile: not 0; null: none is
};

}  // namespace pinocchio
