// A stream of frames: several are in flight at once, and each is delivered once, in order.
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

// The content of a frame. Cheap to copy: moving a light or the camera copies no geometry.
struct FrameRequest {
  Scene scene;
  std::shared_ptr<const Tracer> tracer;  // of the scene's mesh; null: the settings trace nothing
  Settings settings;                     // resolved
  View view;
  // One value for each tile of 32 x 32 pixels, row by row. Where it is not 0 nothing is traced, and the
  // picture there is undefined. Null: all tiles are traced.
  std::shared_ptr<const std::vector<std::uint8_t>> left_out{};
  // With denoise: the mean of the samples so far is shown after each, so that it is filtered from the first
  // one on, and not after the last of Settings::spp alone.
  bool shows_samples = false;

  friend bool operator==(const FrameRequest&, const FrameRequest&) = default;
};

// A finished frame. It is valid only inside the callback.
class Frame {
 public:
  explicit Frame(FrameSlot& slot) : slot_(slot) {}

  [[nodiscard]] const FrameRequest& request() const;
  // Without the GPU's times, which are known later.
  [[nodiscard]] FrameRecord& record() const;
  // The picture on the GPU, in linear light, row 0 on top. If the CPU drew alone, this call uploads it.
  // Throws NoOpenGlError if there is no OpenGL.
  [[nodiscard]] const gl::Texture& texture() const;
  // The texture's OpenGL name, for programs with their own context.
  [[nodiscard]] unsigned texture_name() const;
  // The picture on the CPU, with its inputs. Waits for the GPU.
  [[nodiscard]] FrameResult read() const;
  // The same without ids, mask and reflection.
  void read_color(Image<glm::vec4>& color) const;
  // Without a copy where the CPU put the picture together; else it is read into `memory`, which is returned.
  [[nodiscard]] const Image<glm::vec4>& color(Image<glm::vec4>& memory) const;
  // All data of the frame, for hybrid/inspect.
  [[nodiscard]] FrameSlot& slot() const { return slot_; }

 private:
  FrameSlot& slot_;
};

// The callbacks for finished frames. Either may be empty.
struct FrameSinks {
  std::function<void(Frame&)> frame{};               // before the frame's buffers are used again
  std::function<void(const FrameRecord&)> record{};  // later, when the GPU's times are known
};

// An ordered stream of frames on an Engine, which must outlive it. It is used on the Engine's thread. Unless
// frames are reprojected, a picture consists of its own frame's parts only, so that the pipelined picture is
// the synchronous one, bit for bit.
class Renderer {
 public:
  // `progress` advances by one step for each traced frame, and must outlive the Renderer. After it is
  // cancelled, submit and drain throw Cancelled. Delivered frames are complete.
  Renderer(Engine& engine, FrameSinks sinks, Progress* progress = nullptr);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Begins a frame and delivers the frames that this finishes. If the settings reuse frames and the request
  // repeats the last one, nothing is drawn, traced or sent: frames in flight are delivered, then the last
  // picture again. An error of the tracing thread is thrown when its frame would be delivered; only that
  // frame is lost. If OpenGL fails, all frames in flight are lost, and the next submit starts again.
  // Throws OpenGlError: NoOpenGlError if there is no OpenGL, OpenGlLostError if its context is lost.
  void submit(const FrameRequest& request);
  // The same for a window, without waiting for the CPU: delivers finished frames, and begins the frame unless
  // the CPU is behind. False: the frame did not begin; try again later with a current request.
  bool try_submit(const FrameRequest& request);
  // Delivers finished frames and gives the CPU the next frame in flight, without waiting for it. True: no
  // frame is left.
  bool advance();
  // Whether the CPU is tracing a frame.
  [[nodiscard]] bool is_tracing() const;
  // Waits for all frames in flight and delivers them.
  void drain();

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace pinocchio
