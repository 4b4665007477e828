#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "hybrid/design.h"
#include "hybrid/flight.h"

namespace pinocchio {

// When the GPU gets the CPU's part of a frame.
enum class Exchange {
  sync,       // at once: everybody waits
  pipelined,  // frames later: GPU and CPU work on different frames meanwhile
  reproject,  // design 1, never waited for: the newest raster at once, an older frame's part warped to it
};
[[nodiscard]] const char* exchange_name(Exchange exchange);

// From the frame whose camera was sampled to the one whose turn it is when its picture is delivered,
// pipelined: design 1 uploads after the CPU is done, design 2's CPU part fits beside the next raster.
inline constexpr int kLatencyFrames = 2;
inline constexpr int kLatencyFramesDesign2 = 1;
inline constexpr int kFramesInFlight = kLatencyFrames + 1;

// Draws frames, several in flight at once, and delivers each once, in order; unless reprojected, a picture
// is made of its own frame's parts alone. Lives on the thread of the GL context.
class FrameLoop {
 public:
  struct Sinks {
    std::function<void(Flight&)> picture;            // finished: Flight::picture, before its slot is reused
    std::function<void(const FrameRecord&)> record;  // later, when the GPU's clock has told all
  };

  FrameLoop(Workers& workers, std::shared_ptr<Programs> programs, Exchange exchange, gl::Mapping mapping,
            Sinks sinks);
  FrameLoop(Workers& workers, const gl::ShaderSource& shaders, Exchange exchange, gl::Mapping mapping,
            Sinks sinks)
      : FrameLoop(workers, std::make_shared<Programs>(shaders), exchange, mapping, std::move(sinks)) {}

  // Begins a frame and delivers what that finishes. Where the plan reuses and the request is the last one
  // again, nothing is drawn, traced or sent: all in flight is delivered, then the last picture once more.
  // What went wrong on a thread that traced a frame is thrown when that frame would have been delivered; the
  // frame is lost, the others are not. Throws EnvironmentError where the context is lost.
  void submit(const FrameRequest& request);
  // The passes' programs, to share with others' or to reload when their files change.
  [[nodiscard]] const std::shared_ptr<Programs>& programs() const { return passes_.programs; }
  // Delivers every frame that is still in flight.
  void drain();
  // From the next frame on; delivers what is in flight.
  void set_exchange(Exchange exchange);

  // The finished picture on the CPU, linear RGBA; waits for the GPU.
  static void read_picture(Flight& frame, Image<glm::vec4>& color);
  // Flight::ids, also where the CPU does not have them (yet); waits for the GPU.
  static void read_ids(Flight& frame);

 private:
  [[nodiscard]] const Design& design_of(const Flight& frame) const;
  [[nodiscard]] int latency_of(const Plan& plan) const;
  [[nodiscard]] Flight* frames_back(int n);  // begun n frames before the newest; null: there is none
  bool repeat(const FrameRequest& request);
  Flight& begin(const FrameRequest& request);
  void submit_reprojected(Flight& now);
  void start_trace(Flight& frame);
  void take_traced(Flight& frame);
  void finish(Flight& frame);
  void deliver(Flight& frame, const Flight* older);
  void retire(Flight& frame);

  Passes passes_;
  Design1 design1_;
  Design2 design2_;
  Exchange exchange_;
  Sinks sinks_;
  gl::GpuClock clock_;
  std::uint64_t next_number_ = 0;
  int generation_ = 0;                          // of the programs that drew the newest frame
  std::uint64_t drawn_ = 0;                     // frames that were not repeats
  std::vector<std::unique_ptr<Flight>> slots_;  // the n-th of them is in slot n % kFramesInFlight
};

}  // namespace pinocchio
