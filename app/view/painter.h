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
  // One of the two is null: whether the GPU had a part in it, or the CPU drew alone.
  Flight* flight;
  const Picture* raytraced;
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

  // Begins the frame; in raytrace mode, where one is still being drawn, does not and says false. Delivers
  // what is finished. Throws what went wrong; that frame is lost.
  bool draw(const FrameRequest& request);
  // Delivers what is in flight.
  void drain();
  void set_exchange(Exchange exchange) { loop_.set_exchange(exchange); }
  [[nodiscard]] bool raytracing() const { return raytraced_.valid(); }
  // The last picture in raytrace mode; empty: there is none.
  struct Raytraced {
    FrameRequest request;
    FrameRecord record;
    Picture picture;
  };
  [[nodiscard]] const std::optional<Raytraced>& last_raytraced() const { return last_; }

 private:
  void deliver_raytraced();

  Workers& workers_;
  Sinks sinks_;
  FrameLoop loop_;
  std::future<Raytraced> raytraced_;
  std::optional<Raytraced> last_;  // whose picture texture_ holds
  std::uint64_t next_number_ = 0;  // of raytraced frames
  gl::Upload upload_;
  gl::Texture texture_;
};

}  // namespace pinocchio::app
