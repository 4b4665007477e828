#pragma once

#include <array>
#include <memory>
#include <optional>

#include "gl/objects/draw.h"
#include "gl/objects/framebuffer.h"
#include "gl/objects/texture.h"
#include "gl/transfer/transfer.h"
#include "hybrid/frame/samples.h"
#include "pinocchio/renderer.h"

namespace pinocchio {

class Programs;

// The mean of a still camera's frames, which differ only in their samples. Frame k is requested with
// at_sample(view, k) (core/trace/view/jitter.h).
class Accumulator {
 public:
  explicit Accumulator(Engine& engine);

  // Adds a delivered frame's picture, unclipped. Starts again where scene, settings, camera, size or part
  // differ from the frames before. The sample that was added last is not added twice. A reprojected frame
  // with another view's mask and reflection is no sample: samples() is 0 after it.
  void add(const Frame& frame);
  void reset() { samples_ = 0; }

  [[nodiscard]] int samples() const { return samples_; }
  // True if samples of this request's view were added.
  [[nodiscard]] bool is_of(FrameRequest request) const;
  // The mean, linear RGBA; A: how much of the pixel is covered. samples() > 0.
  [[nodiscard]] const gl::Framebuffer& average() const { return averages_[newest_]; }
  // The same on the CPU; waits for the GPU.
  void read_average(Image<glm::vec4>& color);

 private:
  [[nodiscard]] const gl::Texture& whole_picture(const Frame& frame);
  void draw(const gl::Texture& picture);  // into the average that is not the newest

  Engine& engine_;
  std::shared_ptr<Programs> programs_;
  gl::FullscreenTriangle triangle_;
  // In floats: an n-th of the n-th sample is added, which in halves rounds to 0 from the 2048th on, and to
  // visible steps long before. One is read while the other is written.
  std::array<gl::Framebuffer, 2> averages_;
  Image<glm::vec4> whole_;  // the unclipped picture, which only the CPU has
  gl::Texture whole_texture_;
  gl::Upload upload_;
  std::size_t newest_ = 0;
  int samples_ = 0;
  std::optional<FrameRequest> of_;  // the newest sample
};

}  // namespace pinocchio
