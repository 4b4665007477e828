#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/trace/view.h"
#include "hybrid/frame.h"
#include "hybrid/picture.h"

namespace pinocchio {

// Draws pictures of one scene in any mode and brings them to the CPU: each once, in order, on the
// caller's thread.
class Renderer {
 public:
  struct Settings {
    Exchange exchange = Exchange::sync;
    gl::Mapping mapping = gl::Mapping::each_time;
    int spp = 1;           // samples a pixel: the first at its centre, the others spread over it
    bool pictures = true;  // brought to the CPU; else they stay on the GPU and only records are delivered
  };
  struct Sinks {
    std::function<void(Picture&&)> picture;
    std::function<void(const FrameRecord&)> record;  // one a sample, in order
  };

  // Modes but raytrace want a current OpenGL context that outlives this.
  Renderer(std::shared_ptr<const PreparedScene> scene, const Plan& plan, Workers& workers,
           const Settings& settings, Sinks sinks);

  // Draws what is submitted from now on by another plan of the same mode, that the scene is prepared for.
  void use(const Plan& plan) { plan_ = plan; }
  // Begins a picture and delivers what that finishes.
  void submit(const View& view);
  // Delivers what is still in flight.
  void drain();

 private:
  void submit_sample(const FrameRequest& request);
  void take(Flight& frame);
  void add_sample(Picture&& sample);

  std::shared_ptr<const PreparedScene> scene_;
  Plan plan_;
  Workers& workers_;
  Settings settings_;
  Sinks sinks_;
  std::optional<FrameLoop> loop_;             // none where the CPU draws alone
  std::uint64_t next_number_ = 0;             // of samples, where there is no loop
  std::optional<FrameRequest> last_request_;  // likewise; last_sample_ is its picture, where the plan reuses
  Picture last_sample_;
  Picture picture_;  // of which samples_ samples are in
  int samples_ = 0;
};

}  // namespace pinocchio
