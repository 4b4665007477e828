#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "hybrid/flight.h"
#include "hybrid/steps.h"

namespace pinocchio {

// When the GPU gets the CPU's part of a frame.
enum class Exchange {
  sync,       // at once: everybody waits
  pipelined,  // two frames later: GPU and CPU work on different frames meanwhile
};
[[nodiscard]] const char* exchange_name(Exchange exchange);

// From the frame whose camera was sampled to the one whose turn it is when its picture is delivered.
inline constexpr int kLatencyFrames = 2;
inline constexpr int kFramesInFlight = kLatencyFrames + 1;

// Draws frames, several in flight at once, and delivers each once, in order; a picture is made of its own
// frame's parts alone. Lives on the thread of the GL context.
class FrameLoop {
 public:
  struct Sinks {
    std::function<void(Flight&)> picture;            // finished: Flight::picture, before its slot is reused
    std::function<void(const FrameRecord&)> record;  // later, when the GPU's clock has told all
  };

  FrameLoop(Workers& workers, const std::filesystem::path& shaders, Exchange exchange, gl::Mapping mapping,
            Sinks sinks);

  // Begins a frame and delivers what that finishes. What went wrong on a thread that traced a frame is
  // thrown when that frame would have been delivered; the frame is lost, the others are not.
  void submit(const FrameRequest& request);
  // Delivers every frame that is still in flight.
  void drain();

  [[nodiscard]] const Steps& steps() const { return steps_; }

 private:
  Flight& begin(const FrameRequest& request);
  [[nodiscard]] Flight* frames_back(int n);  // begun n frames before the newest; null: there is none
  void start_trace(Flight& frame);
  void finish(Flight& frame);
  void retire(Flight& frame);

  Steps steps_;
  Exchange exchange_;
  Sinks sinks_;
  std::uint64_t next_number_ = 0;
  std::vector<std::unique_ptr<Flight>> slots_;  // frame n is in slot n % kFramesInFlight
};

}  // namespace pinocchio
