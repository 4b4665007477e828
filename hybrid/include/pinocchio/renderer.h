// A stream of frames: several in flight at once, each delivered once, in order.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "pinocchio/frame.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"
#include "pinocchio/settings.h"
#include "pinocchio/tracer.h"
#include "pinocchio/view.h"

namespace pinocchio {

namespace gl {
class Texture;
}
class Engine;
struct FrameSlot;

// What a frame is to show. A cheap value: moving a light or the camera copies no geometry.
struct FrameRequest {
  Scene scene;
  std::shared_ptr<const Tracer> tracer;  // of the scene's mesh; null where the settings trace nothing
  Settings settings;                     // resolved
  View view;
  // Tiles of 32 x 32 pixels, row by row, of which nothing is traced where it is not 0: what the frame shows
  // there does not count. Null: there are none.
  std::shared_ptr<const std::vector<std::uint8_t>> left_out{};

  friend bool operator==(const FrameRequest&, const FrameRequest&) = default;
};

// A finished frame, valid inside the callback that it is given to.
class Frame {
 public:
  explicit Frame(FrameSlot& slot) : slot_(slot) {}

  [[nodiscard]] const FrameRequest& request() const;
  // Without what is known later only: the GPU's times.
  [[nodiscard]] FrameRecord& record() const;
  // The picture on the GPU, linear light, row 0 on top; where the CPU drew alone it is sent there now.
  // Throws NoOpenGlError where there is none.
  [[nodiscard]] const gl::Texture& texture() const;
  // Its OpenGL name, for programs with a context of their own.
  [[nodiscard]] unsigned texture_name() const;
  // The picture on the CPU, with what it was made of; waits for the GPU.
  [[nodiscard]] FrameResult read() const;
  // The same without ids, mask and reflection.
  void read_color(Image<glm::vec4>& color) const;
  // Everything that it was made of: for those who look inside (hybrid/inspect).
  [[nodiscard]] FrameSlot& slot() const { return slot_; }

 private:
  FrameSlot& slot_;
};

// What is done with finished frames; either may be left out.
struct FrameSinks {
  std::function<void(Frame&)> frame{};               // before its buffers are used again
  std::function<void(const FrameRecord&)> record{};  // later, when the GPU's clock has told all
};

// One ordered stream of frames on an Engine, which must outlive it; used from the Engine's thread. Unless
// reprojected, a picture is made of its own frame's parts alone, so that the pipelined picture is the
// synchronous one, bit for bit.
class Renderer {
 public:
  // `progress` advances by a step a frame, while it is traced, and outlives the Renderer. Once it is
  // cancelled, submit and drain throw Cancelled; frames that were delivered are whole.
  Renderer(Engine& engine, FrameSinks sinks, Progress* progress = nullptr);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Begins a frame and delivers what that finishes. Where the settings reuse and the request is the last one
  // again, nothing is drawn, traced or sent: all in flight is delivered, then the last picture once more.
  // What went wrong on the tracing thread is thrown when that frame would have been delivered; the frame is
  // lost, the others are not. Where OpenGL fails, all in flight are lost, and the next frame starts afresh.
  // Throws OpenGlError: NoOpenGlError where there is none, OpenGlLostError where its context is lost.
  void submit(const FrameRequest& request);
  // The same for a window, which never waits for the CPU: delivers what is done, and begins the frame where
  // the CPU is not behind. False: it is not begun; try again with what is wanted then.
  bool try_submit(const FrameRequest& request);
  // Delivers what is done of the frames in flight, and gives the CPU the next of them, without waiting for
  // it. True: none is left.
  bool advance();
  // Whether the CPU is at work on a frame.
  [[nodiscard]] bool is_tracing() const;
  // Delivers every frame that is still in flight.
  void drain();

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace pinocchio
