#pragma once

#include <memory>
#include <optional>

#include "core/image/light_histogram.h"
#include "gl/draw.h"
#include "gl/framebuffer.h"
#include "gl/transfer.h"

namespace pinocchio {

class Engine;
class Programs;

// reads: a picture, linear light. Counts its pixels by their light: of every second or third, across and
// down, where it has more than a million.
class HistogramPass {
 public:
  explicit HistogramPass(Engine& engine);

  // Does not wait: the count is there some frames later.
  void start(const gl::Texture& picture);
  [[nodiscard]] bool started() const { return started_; }
  // What was started last; waits where the GPU is not done.
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
