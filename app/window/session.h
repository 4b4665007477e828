#pragma once

#include <memory>
#include <optional>

#include "app/window/comparison.h"
#include "app/window/file_watch.h"
#include "app/window/gui.h"
#include "app/window/model.h"
#include "app/window/navigation.h"
#include "hybrid/gpu/present_pass.h"
#include "pinocchio/renderer.h"
#include "hybrid/inspect/accumulator.h"

namespace pinocchio::app {

// What `view` takes from the command line.
struct ViewOptions {
  DrawOptions draw;
  float exposure_ev = 0.0f;
  bool watch = false;  // load scene and shaders anew when they change
  bool vsync = true;
};

// A scene in a window, from opening to closing: session.cpp takes events and changes, session_draw.cpp draws,
// session_actions.cpp does what keys and buttons ask.
class Session {
 public:
  Session(gl::Window& window, const ViewOptions& options);

  // Returns when the window is closed or the program interrupted. Ends the verb where the scene of the
  // command line cannot be read.
  void run();
  // Whether a thread still reads a scene.
  [[nodiscard]] bool loading() const { return loader_.busy(); }

 private:
  // session.cpp
  void take_events();
  void fly_on();
  void take_key(const gl::KeyEvent& event);
  void take_drop(const gl::DropEvent& event);
  void load();
  void take_news();
  void take_scene(SceneLoader::News& news);
  void take_file_changes();
  void apply_changes();
  [[nodiscard]] bool can_draw(const SceneStats& stats);
  [[nodiscard]] Expected<Settings> resolved(const Settings& wanted, const SceneStats& stats,
                                            bool keeps_mask) const;
  [[nodiscard]] bool try_settings(const ViewSettings& settings);
  void want_tree(const Settings& settings);
  [[nodiscard]] double patience_s() const;

  // session_draw.cpp
  void draw();
  void draw_scene();
  void follow_reference(const FrameRequest& request);
  [[nodiscard]] bool gathers() const;
  [[nodiscard]] int most_samples() const;
  [[nodiscard]] glm::ivec2 picture_size() const;
  [[nodiscard]] FrameRequest request() const;
  [[nodiscard]] FrameRequest next_request();
  void take_frame(const Frame& frame);
  [[nodiscard]] const gl::Texture& chosen_buffer(const Frame& frame);
  void compare(const Frame& frame);
  void show(const gl::Texture* picture);
  void present(const gl::Texture& picture);

  // session_actions.cpp
  void perform(Action action);
  void show_camera(std::size_t number);
  void catch_up();
  void take_screenshot();
  void write_frame_exr(const std::string& file);
  void write_window_png();
  void save_camera();
  void print_command();
  [[nodiscard]] std::string file_name(const std::vector<std::string>& extensions) const;

  gl::Window& window_;
  ViewOptions options_;
  Model model_;
  Navigation navigation_;
  SceneLoader loader_;
  Gui gui_;
  Engine engine_;
  std::shared_ptr<Programs> programs_;
  PresentPass present_;
  InspectPass inspect_;
  Accumulator accumulator_;
  std::unique_ptr<Comparison> comparison_;  // null: none is asked for
  Renderer renderer_;
  std::optional<FileWatch> shader_watch_, scene_watch_;  // with --watch

  const gl::Texture* last_ = nullptr;  // picture shown last
  bool last_is_light_ = true;          // exposure is for light alone
  std::optional<FrameRequest> asked_;  // of the newest frame
  int sample_ = 0;                     // of the still camera, the next to ask for
  bool shown_ = false;                 // something, this turn
  bool idle_ = false;                  // nothing new was asked for
  std::optional<Settings> tree_of_;    // by which the scene's tree was built, or is being built
  Camera first_camera_;
  ViewSettings applied_;
  std::vector<Light> applied_lights_;
  bool lights_edited_ = false;  // they are not the file's
  std::string png_file_;        // to write the window to, when it is drawn next
  double last_turn_s_ = 0.0;
};

}  // namespace pinocchio::app
