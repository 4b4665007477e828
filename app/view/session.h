#pragma once

#include <memory>
#include <optional>

#include "app/view/gui.h"
#include "app/view/model.h"
#include "app/view/navigation.h"
#include "app/view/painter.h"
#include "app/view/view_options.h"
#include "hybrid/present_pass.h"

namespace pinocchio::app {

// A scene in a window, from opening to closing.
class Session {
 public:
  Session(gl::Window& window, const ViewOptions& options);

  // Returns when the window is closed or the program interrupted. Ends the verb where the scene of the
  // command line cannot be read.
  void run();
  // Whether a thread still reads a scene.
  [[nodiscard]] bool loading() const { return loader_.busy(); }

 private:
  void take_events();
  void take_key(const gl::KeyEvent& event);
  void take_drop(const gl::DropEvent& event);
  void perform(Action action);
  void perform_camera(Action action);
  void perform_setting(Action action);
  void take_news();
  void apply_changes();
  [[nodiscard]] Expected<Plan> plan_for(const ViewSettings& settings) const;
  [[nodiscard]] bool try_plan(const ViewSettings& settings);
  void draw();
  [[nodiscard]] glm::ivec2 picture_size() const;
  [[nodiscard]] FrameRequest next_request() const;
  void take_painted(const Painted& painted);
  void show(const gl::Texture* picture);
  [[nodiscard]] double patience_s() const;

  gl::Window& window_;
  ViewOptions options_;
  Workers workers_;
  Model model_;
  Navigation navigation_;
  SceneLoader loader_;
  Gui gui_;
  std::unique_ptr<PresentPass> present_;
  std::unique_ptr<Painter> painter_;
  const gl::Texture* last_ = nullptr;  // picture shown last
  Camera first_camera_;
  ViewSettings applied_;
  std::vector<Light> applied_lights_;
  bool shown_anything_ = false;
  double last_turn_s_ = 0.0;
};

}  // namespace pinocchio::app
