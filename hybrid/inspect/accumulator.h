#pragma once

#include <array>
#include <memory>
#include <optional>

#include "gl/draw.h"
#include "gl/framebuffer.h"
#include "gl/texture.h"
#include "gl/transfer.h"
#include "pinocchio/renderer.h"

namespace pinocchio {

class Programs;

// A still camera's picture: the mean of the pictures of frames that differ in nothing but where they sample
// their pixels. Frame k is to be asked for with at_sample(view, k) (core/trace/jitter.h).
class Accumulator {
 public:
  explicit Accumulator(Engine& engine);

  // Adds a delivered frame's picture, that which the CPU sent in bytes as it was before. Begins anew by
  // itself where scene, plan, camera, size or part are not those of the frames before; a sample that was the
  // last one added is not added twice. A reprojected frame whose answer is of another view is no sample of
  // this one: samples() is 0 after it.
  void add(const Frame& frame);
  void reset() { samples_ = 0; }

  [[nodiscard]] int samples() const { return samples_; }
  // The mean, RGBA linear, A 0 to 1 as much of the pixel as is covered; samples() > 0.
  [[nodiscard]] const gl::Framebuffer& average() const { return averages_[newest_]; }
  // The same on the CPU; waits for the GPU.
  void read_average(Image<glm::vec4>& color);

 private:
  [[nodiscard]] const gl::Texture& whole_picture(const Frame& frame);
  void draw(const gl::Texture& picture);  // into the average that is not the newest

  Engine& engine_;
  std::shared_ptr<Programs> programs_;
  gl::FullscreenTriangle triangle_;
  // Floats: of the n-th sample an n-th is added, which in halves rounds to nothing from the 2048th on, and
  // to steps a person sees long before. One is read while the other is written.
  std::array<gl::Framebuffer, 2> averages_;
  Image<glm::vec4> whole_;  // what the GPU lacks: the picture before it was cut off
  gl::Texture whole_texture_;
  gl::Upload upload_;
  std::size_t newest_ = 0;
  int samples_ = 0;
  std::optional<FrameRequest> of_;  // the newest sample
};

}  // namespace pinocchio
