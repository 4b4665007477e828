#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/window/actions.h"
#include "app/window/camera_control.h"
#include "app/window/history.h"
#include "app/window/scene_loader.h"
#include "app/window/settings.h"
#include "core/base/clock.h"

namespace pinocchio::app {

// Something to read for some seconds.
struct Notice {
  std::string text;
  double until_s = 0.0;
};

// What the window shows and what can be changed in it: the session fills it, the overlay shows and edits it.
struct Model {
  ViewSettings settings;
  CameraControl camera;
  Scene scene;                           // with the lights as edited
  SceneStats stats;                      // of it
  std::shared_ptr<const Tracer> tracer;  // null: nothing is traced, or the tree is not built yet
  bool lights_changed = false;           // by the overlay: the session takes them over
  Settings drawn;                        // resolved: by which frames are drawn now
  History history;
  int samples = 0;  // gathered by the still camera

  SceneLoader::Progress loading;
  std::map<std::string, std::string> errors;  // by what failed; each stays until it is mended
  std::string legend;                         // what the buffer's colours mean; empty: the picture is shown
  std::string comparison;                     // with the reference, in words; empty: there is none
  std::deque<Notice> notices;
  std::vector<Action> asked;  // by the overlay's buttons

  glm::ivec2 window_pixels{0, 0}, picture_size{0, 0};
  std::string renderer;  // OpenGL's, in words
  int threads = 0;       // that trace

  [[nodiscard]] bool has_scene() const { return !scene.source.empty(); }
  void notify(const std::string& text, double seconds = 4.0) { notices.push_back({text, now_s() + seconds}); }
};

}  // namespace pinocchio::app
