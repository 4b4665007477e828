#pragma once

#include <memory>

#include "hybrid/flight.h"
#include "hybrid/shading_passes.h"
#include "hybrid/visibility_pass.h"

namespace pinocchio {

// What the designs share.
struct Passes {
  explicit Passes(std::shared_ptr<Programs> of)
      : programs(std::move(of)), visibility(programs), shading(programs) {}
  std::shared_ptr<Programs> programs;
  VisibilityPass visibility;
  ShadingPasses shading;
};

// What is done to a frame, one function a step; the order is hybrid/frame.cpp's. None waits for the GPU
// but fetch.
class Design {
 public:
  Design(Workers& workers, Passes& passes) : workers_(workers), passes_(passes) {}
  virtual ~Design() = default;
  Design(const Design&) = delete;
  Design& operator=(const Design&) = delete;

  // GPU: what each pixel sees; where the plan traces, it sets out for the CPU.
  virtual void draw(Flight& frame) const = 0;
  // Takes what has come, and opens the buffers that the CPU's answer will travel in.
  virtual void fetch(Flight& frame) const = 0;
  // CPU, on any thread: shadow mask, reflection and what the design makes of them, written where it travels.
  virtual void trace(Flight& frame) const = 0;
  // Sends it off.
  virtual void upload(Flight& frame) const = 0;
  // GPU: the picture. `older`: the frame whose mask and reflection are warped to this one, else its own.
  virtual void composite(Flight& frame, const Flight* older) const = 0;

 protected:
  void draw_ids(Flight& frame) const;
  void send_to_cpu(Flight& frame, Outgoing& picture, Transfer transfer) const;
  [[nodiscard]] ShadingPasses::Inputs inputs_of(const Flight& frame) const;
  Workers& workers_;
  Passes& passes_;
};

// The slides' first: the CPU sends mask and reflection, the GPU puts the picture together.
class Design1 final : public Design {
 public:
  using Design::Design;
  void draw(Flight& frame) const override;
  void fetch(Flight& frame) const override;
  void trace(Flight& frame) const override;
  void upload(Flight& frame) const override;
  void composite(Flight& frame, const Flight* older) const override;
};

// The slides' second: the GPU sends the light that needs no shadow ray, the CPU adds the rest and sends the
// finished picture, 24 bit sRGB.
class Design2 final : public Design {
 public:
  using Design::Design;
  void draw(Flight& frame) const override;
  void fetch(Flight& frame) const override;
  void trace(Flight& frame) const override;
  void upload(Flight& frame) const override;
  void composite(Flight& frame, const Flight* older) const override;
};

// Design 1: the frame's answer where the GPU has it, as the composite reads it.
[[nodiscard]] ShadingPasses::Traced answer_on_gpu(const Flight& traced);

// Buffers are made anew only where size or format changed since the slot's last frame.
void fit(gl::Framebuffer& target, glm::ivec2 size, const gl::PixelFormat& format, bool with_depth = false);
void fit(gl::Texture& texture, glm::ivec2 size, const gl::PixelFormat& format);
template <class T>
void fit(Image<T>& image, glm::ivec2 size) {
  if (image.size() != size) image = Image<T>(size);
}

}  // namespace pinocchio
