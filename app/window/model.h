#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "app/window/actions.h"
#include "app/window/camera_control.h"
#include "app/window/history.h"
#include "app/window/live_scene.h"
#include "app/window/scene_loader.h"
#include "app/window/settings.h"

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
  LiveScene scene;
  std::vector<Light> lights;    // as edited; of the scene where it casts is left as it is
  bool lights_changed = false;  // by the overlay: the session takes them over
  Plan plan;                    // of the frames that are drawn now
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

  void notify(const std::string& text, double seconds = 4.0) { notices.push_back({text, now_s() + seconds}); }
};

}  // namespace pinocchio::app
