#pragma once

#include <optional>

#include "app/window/screen/screen.h"
#include "app/window/screen/wireframe.h"
#include "hybrid/inspect/accumulator.h"
#include "hybrid/inspect/inspect_pass.h"
#include "pinocchio/renderer.h"

namespace pinocchio::app {

// Draws the scene frame by frame: decides which frame is drawn next, gathers the samples of a still camera,
// and notes when nothing is left to draw.
class FrameLoop {
 public:
  // sinks: called after a frame is shown, and when its figures are known.
  FrameLoop(Engine& engine, Model& model, Screen& screen, SplitView& split, FrameSinks sinks);

  // One turn: delivers a frame that is done, or begins the next one. What OpenGL cannot draw becomes a
  // message.
  void draw();
  // Whether input changed only what is over the picture, such as panels and exposure. That is shown before
  // another sample is begun.
  [[nodiscard]] bool only_overlay_changed() const;
  [[nodiscard]] bool is_tracing() const { return renderer_.is_tracing(); }

  void drain();
  // The newest frame is delivered again, to be shown in another way.
  void deliver_again() { again_ = true; }
  // The same request is another picture now.
  void restart();
  // Draws the frame again by other settings, apart from the window's frames, with all its layers.
  [[nodiscard]] FrameResult draw_now(const Settings& settings);
  // Draws the frame on a transparent background, with as many samples as are gathered, as far as that is
  // quick.
  [[nodiscard]] FrameResult draw_transparent(Settings settings);
  // Gives the picture of this request the mean of its gathered samples, if they are gathered; its layers
  // remain those of one sample.
  void add_gathered(const FrameRequest& request, FrameResult& picture);

 private:
  [[nodiscard]] FrameRequest next_request();
  [[nodiscard]] int most_samples() const;
  void draw_next();
  void settle();
  void forget_slot();
  void deliver(Frame& frame);
  void read_numbers(const Frame& frame);
  [[nodiscard]] const gl::Texture& chosen_buffer(const Frame& frame);
  [[nodiscard]] ChannelRange channel_range() const;

  Engine& engine_;
  Model& model_;
  Screen& screen_;
  SplitView& split_;
  FrameSinks sinks_;
  InspectPass inspect_;
  Accumulator accumulator_;
  Wireframe wireframe_;
  std::optional<FrameRequest> newest_;  // the request drawn last
  std::optional<FrameRequest> tried_;   // the last one that the renderer was given
  int sample_ = 0;                      // the still camera's next
  bool shows_slot_ = false;             // the picture that is shown is the renderer's
  bool again_ = false;                  // newest_ is to be delivered again
  bool settled_ = false;                // newest_ was delivered again since it was drawn
  Renderer renderer_;
};

}  // namespace pinocchio::app
