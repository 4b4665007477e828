#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>

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

  Painter(Workers& workers, std::shared_ptr<Programs> programs, Exchange exchange, Sinks sinks);
  ~Painter();

  // Begins the frame, or in raytrace mode where one is still being drawn, does not. Delivers what is
  // finished. Throws what went wrong; that frame is lost.
  void draw(const FrameRequest& request);
  // Delivers what is in flight.
  void drain();
  void set_exchange(Exchange exchange) { loop_.set_exchange(exchange); }
  [[nodiscard]] bool raytracing() const { return raytraced_.valid(); }

 private:
  struct Raytraced {
    FrameRequest request;
    FrameRecord record;
    Picture picture;
  };
  void deliver_raytraced();

  Workers& workers_;
  Sinks sinks_;
  FrameLoop loop_;
  std::future<Raytraced> raytraced_;
  std::optional<FrameRequest> last_raytraced_;  // whose picture texture_ holds
  std::uint64_t next_number_ = 0;               // of raytraced frames
  gl::Upload upload_;
  gl::Texture texture_;
};

}  // namespace pinocchio::app
