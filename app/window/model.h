#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/actions.h"
#include "app/window/camera_control.h"
#include "app/window/history.h"
#include "app/window/messages.h"
#include "app/window/panels.h"
#include "app/window/pixel_report.h"
#include "app/window/scene_files.h"
#include "app/window/scene_loader.h"
#include "app/window/settings.h"
#include "core/image/light_histogram.h"
#include "hybrid/inspect/present_pass.h"

namespace pinocchio::app {

// How the timeline is looked at.
struct TimelineView {
  bool paused = false;
  int frames = 6;                    // shown at once
  int back = 0;                      // frames before the newest, paused
  std::vector<FrameRecord> records;  // those there were when it was paused
};

// Where an animated scene's time is.
struct Playback {
  bool playing = false;
  double time_s = 0.0;
};

// The folder that the panel Files shows.
struct FileList {
  std::filesystem::path folder;  // empty: the scene's
  std::vector<FolderEntry> entries;

  void go_to(const std::filesystem::path& to) {
    folder = to;
    entries = scenes_in(to);
  }
};

// What the window shows and what can be changed in it: the session fills it, the overlay shows and edits it.
struct Model {
  ViewSettings settings;
  OpenPanels panels;
  CameraControl camera;
  Scene scene;                              // with the lights as edited
  SceneStats stats;                         // of it
  std::shared_ptr<const Tracer> tracer;     // null: nothing is traced, or the tree is not built yet
  bool lights_changed = false;              // by the overlay: the session takes them over
  int material = 0;                         // that the panel Materials shows
  std::optional<Material> edited_material;  // what it is to be: the session takes it over
  std::optional<PixelReport> pixel;         // under the pointer; nothing: the panel is closed
  std::optional<double> pixel_error;        // there, against the reference; nothing: it is not complete
  std::optional<LightHistogram>
      histogram;  // of the picture; nothing: the panel Drawing is closed, or no light is shown
  FileList files;
  Settings drawn;  // resolved: by which frames are drawn now
  History history;
  TimelineView timeline;
  Playback playback;
  int samples = 0;      // gathered by the still camera
  bool asleep = false;  // the picture is done: nothing is drawn until something changes

  SceneLoader::Progress loading;
  Messages messages;
  std::string legend;               // what the buffer's colours mean; empty: the picture is shown
  ChannelRange shown_range;         // of the channel that is shown
  std::string comparison;           // with the reference, in words; empty: there is none
  std::vector<Action> asked;        // by the overlay's buttons
  std::string file_to_open;         // by the overlay; empty: none
  int camera_to_show = -1;          // of the scene's, by the overlay
  std::vector<std::string> recent;  // scene files, newest first

  glm::ivec2 window_pixels{0, 0}, picture_size{0, 0};
  PictureZoom zoom;
  std::string recording;  // name of the sequence that is written; empty: none
  std::string renderer;   // OpenGL's, in words
  int threads = 0;        // that trace

  [[nodiscard]] bool has_scene() const { return !scene.source.empty(); }
};

}  // namespace pinocchio::app
