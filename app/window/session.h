#pragma once

#include <optional>

#include "app/window/applied_settings.h"
#include "app/window/input.h"
#include "app/window/leave.h"
#include "app/window/model/preferences.h"
#include "app/window/pointing.h"
#include "app/window/recording.h"
#include "app/window/scene/playback.h"
#include "app/window/scene/scene_edits.h"

namespace pinocchio::app {

// What `view` takes from the command line.
struct ViewOptions {
  DrawOptions draw;
  BudgetOptions budget;
  float exposure_ev = 0.0f;
  ToneMap tone_map = ToneMap::clip;
  std::string stats_json;  // file for how quickly the window responded. Empty: none
  bool watch = false;      // load scene and shaders again when their files change
  bool vsync = true;
};

// A scene in a window, from opening to closing: connects the parts that share the model, and performs what
// they request.
class Session {
 public:
  Session(gl::Window& window, const ViewOptions& options);
  ~Session();

  // Returns when the window is closed or the program interrupted.
  void run();
  // Whether a thread still reads a scene.
  [[nodiscard]] bool is_loading() const { return source_.is_busy(); }
  [[nodiscard]] const Pace& pace() const { return screen_.pace(); }
  [[nodiscard]] const Scene& scene() const { return model_.scene; }
  // The verb's exit code: why no scene could be opened.
  [[nodiscard]] ExitCode code() const { return source_.code(); }

 private:
  [[nodiscard]] double patience_s() const;
  void advance();
  void poll_scene();
  void show_kept();
  [[nodiscard]] bool can_draw(const SceneStats& stats);
  [[nodiscard]] std::shared_ptr<const Environment> opened_environment() const;
  void show_scene(SceneLoader::News& news);
  void poll_files();
  void apply_changes();
  void draw();
  void inspect_pixel();

  void perform_requests();
  void perform(Action action);
  void write_file(Action action);
  void close_something();

  gl::Window& window_;
  Preferences preferences_;
  Model model_;
  Engine engine_;
  SplitView split_;
  Screen screen_;
  Input input_;
  FrameLoop frames_;
  BudgetControl budget_;
  SceneSource source_;
  AppliedSettings settings_;
  SceneEdits edits_;
  Playback playback_;
  Pointing pointing_;
  HiddenParts parts_;
  Recording recording_;
  Leave leave_;
  std::optional<FileWatch> shader_watch_;  // with --watch
  Camera first_camera_;                    // of the scene
  double last_turn_s_ = 0.0;
};

}  // namespace pinocchio::app
