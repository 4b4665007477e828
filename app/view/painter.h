#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <memory>

#include "hybrid/frame.h"
#include "hybrid/picture.h"

namespace pinocchio::app {

// A finished picture, on the GPU: linear light, row 0 on top.
struct Painted {
  const gl::Texture& picture;
  const FrameRequest& request;
  FrameRecord& record;  // without the present stage, which is the taker's
  Flight* flight;       // null: the CPU drew alone
};

// Draws frames in any mode, so that the window never waits for the CPU alone: in raytrace mode a thread
// draws one frame after the other, and between two the window shows the last.
class Painter {
 public:
  struct Sinks {
    std::function<void(Painted)> painted;
    std::function<void(const FrameRecord&)> record;
  };

  Painter(Workers& workers, const std::filesystem::path& shaders, Exchange exchange, Sinks sinks);
  ~Painter();

  // Begins the frame, or in raytrace mode where one is still being drawn, does not. Delivers what is
  // finished. Throws what went wrong; that frame is lost.
  void draw(const FrameRequest& request);
  // Delivers what is in flight.
  void drain();
  void set_exchange(Exchange exchange) {
    exchange_ = exchange;
    loop_->set_exchange(exchange);
  }
  // Takes the shaders anew, tries them on a frame like this one (null: none) and keeps the old ones where
  // that throws.
  void reload_shaders(const FrameRequest* like);
  [[nodiscard]] bool raytracing() const { return raytraced_.valid(); }

 private:
  struct Raytraced {
    FrameRequest request;
    FrameRecord record;
    Picture picture;
  };
  [[nodiscard]] std::unique_ptr<FrameLoop> make_loop(FrameLoop::Sinks sinks) const;
  [[nodiscard]] FrameLoop::Sinks loop_sinks();
  void deliver_raytraced();

  Workers& workers_;
  std::filesystem::path shaders_;
  Exchange exchange_;
  Sinks sinks_;
  std::unique_ptr<FrameLoop> loop_;
  std::future<Raytraced> raytraced_;
  std::uint64_t next_number_ = 0;  // of raytraced frames
  gl::Upload upload_;
  gl::Texture texture_;  // of the last raytraced picture
};

}  // namespace pinocchio::app
