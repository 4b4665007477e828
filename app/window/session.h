#pragma once

#include <future>
#include <memory>
#include <optional>

#include "app/budget.h"
#include "app/window/comparison.h"
#include "app/window/edit_history.h"
#include "app/window/file_watch.h"
#include "app/window/gui.h"
#include "app/window/model.h"
#include "app/window/navigation.h"
#include "app/window/pace.h"
#include "app/window/preferences.h"
#include "hybrid/inspect/accumulator.h"
#include "hybrid/inspect/histogram_pass.h"
#include "hybrid/inspect/present_pass.h"
#include "pinocchio/pose_ahead.h"
#include "pinocchio/renderer.h"

namespace pinocchio::app {

// What `view` takes from the command line.
struct ViewOptions {
  DrawOptions draw;
  BudgetOptions budget;
  float exposure_ev = 0.0f;
  ToneMap tone_map = ToneMap::clip;
  std::string stats_json;  // file for how quickly the window answered; empty: none
  bool watch = false;      // load scene and shaders anew when they change
  bool vsync = true;
};

// A scene in a window, from opening to closing: session.cpp takes events, session_scene.cpp scenes and
// changes of settings, session_playback.cpp moves animated ones, session_draw.cpp draws, session_actions.cpp
// does what keys and buttons ask.
class Session {
 public:
  Session(gl::Window& window, const ViewOptions& options);
  ~Session();

  // Returns when the window is closed or the program interrupted. Ends the verb where the scene of the
  // command line cannot be read.
  void run();
  // Whether a thread still reads a scene.
  [[nodiscard]] bool loading() const { return loader_.busy(); }
  [[nodiscard]] const Pace& pace() const { return pace_; }
  [[nodiscard]] const Scene& scene() const { return model_.scene; }

 private:
  // session.cpp
  void take_events();
  void fly_on();
  void take_key(const gl::KeyEvent& event);
  void take_button(const gl::ButtonEvent& event);
  void take_scroll(const gl::ScrollEvent& event);
  [[nodiscard]] bool take_click(const gl::ButtonEvent& event);
  void take_asked();
  [[nodiscard]] double patience_s() const;
  void note_edits();

  // session_scene.cpp
  void open(const std::string& file);
  void load(const DrawOptions& options);
  void take_news();
  void take_scene(SceneLoader::News& news);
  void take_file_changes();
  void apply_changes();
  void take_material();
  void set_materials(std::vector<Material> materials);
  [[nodiscard]] bool can_draw(const SceneStats& stats);
  [[nodiscard]] Expected<Settings> resolved(const Settings& wanted, const SceneStats& stats,
                                            bool keeps_mask) const;
  [[nodiscard]] bool try_settings(const ViewSettings& settings);
  void want_tree(const Settings& settings);
  void keep_budget(const Settings& exact);

  // session_playback.cpp
  void play_on(double turn_s);
  void take_pose();
  void want_pose();
  void drop_pose();
  void step_time(int frames);
  [[nodiscard]] bool posing() const { return pose_.valid(); }

  // session_draw.cpp
  void draw();
  void draw_scene();
  bool follow_reference(const FrameRequest& request);
  static constexpr double kBetweenRedraws_s = 0.025;  // while a scene is loaded
  [[nodiscard]] bool wants_redraw() const;
  [[nodiscard]] bool answers_first() const;
  [[nodiscard]] bool gathers() const;
  [[nodiscard]] int most_samples() const;
  [[nodiscard]] glm::ivec2 picture_size() const;
  [[nodiscard]] FrameRequest request() const;
  [[nodiscard]] FrameRequest next_request();
  void take_frame(const Frame& frame);
  void take_record(const FrameRecord& record);
  [[nodiscard]] const gl::Texture& chosen_buffer(const Frame& frame);
  void compare(const Frame& frame);
  [[nodiscard]] ChannelRange channel_range() const;
  void inspect_pixel();
  void count_light();
  void show(const gl::Texture* picture);
  void present(const gl::Texture& picture);

  // session_actions.cpp
  void perform(Action action);
  void close_something();
  void cancel_loading();
  void frame_all();
  void show_camera(std::size_t number);
  void set_pivot();
  void pick_material();
  void expose_for_point();
  [[nodiscard]] glm::ivec2 pixel_under_pointer() const;
  [[nodiscard]] std::optional<PixelReport> report(glm::ivec2 pixel);
  void step_file(int by);
  void restore(const std::optional<EditState>& state, const char* nothing);
  void catch_up();
  void take_screenshot();
  void write_frame_exr(const std::string& file);
  void write_window_png();
  void toggle_recording(bool with_exr);
  void record(const Frame& frame);
  void take_gathered(FrameResult& picture);
  void save_camera();
  void save_gltf();
  void print_command();
  [[nodiscard]] std::string file_name(const std::vector<std::string>& extensions) const;
  [[nodiscard]] EditState edit_state() const;

  gl::Window& window_;
  ViewOptions options_;
  Model model_;
  Navigation navigation_;
  SceneLoader loader_;
  Gui gui_;
  Preferences preferences_;
  Engine engine_;
  PresentPass present_;
  InspectPass inspect_;
  HistogramPass histogram_;
  Accumulator accumulator_;
  std::unique_ptr<Comparison> comparison_;  // null: none is asked for
  Renderer renderer_;
  EditHistory edits_;
  std::unique_ptr<BudgetTrial> trial_;             // null: no plans are being measured
  std::unique_ptr<QualityController> controller_;  // null: there is no budget, or it is not measured yet
  Settings exact_;                                 // that trial_ and controller_ thin out
  std::unique_ptr<PixelInspector> inspector_;      // null: no pixel was looked at yet
  std::optional<FrameRequest> inspected_;          // by what the pixel's report was made
  std::optional<FileWatch> shader_watch_, scene_watch_;  // with --watch
  std::optional<DrawOptions> pending_;                   // of the scene that is being read

  const gl::Texture* last_ = nullptr;  // picture shown last
  bool last_is_light_ = true;          // exposure is for light alone
  std::optional<FrameRequest> asked_;  // of the newest frame
  int sample_ = 0;                     // of the still camera, the next to ask for
  bool shown_ = false;                 // something, this turn
  bool counted_ = false;               // the light of the picture shown last
  double counted_s_ = 0.0;             // when, of that or one before
  bool again_ = false;                 // the newest frame is to be delivered once more
  bool settled_ = false;               // it was, since it was drawn
  bool idle_ = false;                  // nothing is left to draw
  bool over_picture_ = false;          // the pointer is, and not over a panel
  int redraws_ = 3;                    // of the overlay that are due: it settles in as many
  double redrawn_s_ = 0.0;
  std::optional<Settings> tree_of_;  // by which the scene's tree was built, or is being built
  std::shared_ptr<pinocchio::Progress> pose_progress_;
  std::future<Expected<PoseAhead::Pose>> pose_;  // that is being made
  Scene posed_from_;                             // of what
  double pose_s_ = 0.0;                          // its time
  std::optional<double> posed_s_;                // of the scene that is shown; nothing: it is to be posed
  Camera first_camera_;
  ViewSettings applied_;
  std::vector<Light> applied_lights_;
  bool wants_tree_ = false;    // also where frames trace nothing: pixels are looked at
  bool scene_edited_ = false;  // it is not the file's
  int recorded_ = 0;           // frames of the sequence
  bool records_exr_ = false;   // beside its PNG
  Pace pace_;
  std::string png_file_;  // to write the window to, when it is drawn next
  double last_turn_s_ = 0.0;
  double pressed_s_ = 0.0;  // when a click on the picture began, and where
  glm::vec2 pressed_at_{-1.0f}, pointer_{-1.0f};
};

}  // namespace pinocchio::app
