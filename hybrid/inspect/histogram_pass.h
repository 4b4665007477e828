#pragma once

#include <memory>

#include "core/image/light_histogram.h"
#include "gl/objects/draw.h"
#include "gl/objects/framebuffer.h"
#include "gl/transfer/transfer.h"

namespace pinocchio {

class Engine;
class Programs;

// reads: a picture, linear light. Counts its pixels by their light; of a picture with more than a million
// pixels, every second or third, across and down.
class HistogramPass {
 public:
  explicit HistogramPass(Engine& engine);

  // Does not wait: the count is ready some frames later.
  void start(const gl::Texture& picture);
  [[nodiscard]] bool started() const { return started_; }
  // The count that was started last; waits where the GPU is not done.
  [[nodiscard]] LightHistogram take();

 private:
  Engine& engine_;
  std::shared_ptr<Programs> programs_;
  gl::FullscreenTriangle triangle_;
  gl::Framebuffer target_;
  gl::Readback back_;
  bool started_ = false;
};

}  // namespace pinocchio
