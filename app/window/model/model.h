#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/camera/camera_control.h"
#include "app/window/model/actions.h"
#include "app/window/model/history.h"
#include "app/window/model/messages.h"
#include "app/window/model/panels.h"
#include "app/window/model/pixel_report.h"
#include "app/window/model/scene_files.h"
#include "app/window/model/scene_loader.h"
#include "app/window/model/settings.h"
#include "core/image/light_histogram.h"
#include "hybrid/inspect/present_pass.h"
#include "pinocchio/animation.h"
#include "pinocchio/load.h"

namespace pinocchio::app {

// What the timeline shows.
struct TimelineView {
  bool paused = false;
  int frames = 6;                    // shown at once
  int back = 0;                      // frames between the last one shown and the newest, while paused
  std::vector<FrameRecord> records;  // the frames when it was paused
};

// The time of an animated scene.
struct PlaybackState {
  bool playing = false;
  double time_s = 0.0;            // to be shown
  std::optional<double> posed_s;  // of the scene that is shown. Nothing: the scene is to be posed again
  float speed = 1.0f;
  int clip = -1;                         // the animation of the file that is played. -1: all together
  std::shared_ptr<const Animation> all;  // of the file. Null: none
};

// The panel Scene: facts about the file, and its parts, which can be hidden. Parts are nodes, or materials if
// one node has all triangles.
struct SceneParts {
  std::uintmax_t bytes = 0;  // of the file
  std::vector<std::string> extensions, warnings;
  bool are_nodes = false;      // else materials
  std::vector<bool> hidden{};  // by part
  bool changed = false;        // `hidden`, by the overlay

  [[nodiscard]] bool hides() const { return std::ranges::find(hidden, true) != hidden.end(); }
};

// Folder and name of the files that the window writes.
struct SavePlace {
  std::string folder;  // empty: the working directory
  std::string name;    // without extension. Empty: the scene's, with the first free number
  bool replaces = false;
};

// What a person is about to do although the scene has edits that are not saved.
struct Leaving {
  std::string file;     // to open. Empty: the window is closed
  bool reload = false;  // `file` is the shown scene's, which has changed
  // `file` is the shown scene's, to be read again: turned, or with this variant of its materials.
  std::optional<UpAxis> up_axis{};
  std::optional<std::string> variant{};
  bool loaded = false;    // `file` is loaded already, and waits to be shown
  bool is_asked = false;  // the question is on the screen: before that no key answers it
};

struct MaterialEdit {
  Material material;
  std::optional<GltfSurface> surface{};  // of its maps. Nothing: it has none, or not from glTF
};

// The material's name, or its number where it has none.
[[nodiscard]] std::string name_of_material(const Mesh& mesh, std::size_t material);

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
  ViewSettings settings;  // as edited
  ViewSettings applied;   // in force: `settings` of this turn, where the scene can be drawn by them
  OpenPanels panels;
  CameraControl camera;
  Scene scene;                                // with lights and materials as edited
  bool scene_edited = false;                  // the scene is not its file's
  bool unsaved = false;                       // its edits are in no file
  int edits = 0;                              // made in the scene so far
  std::optional<Leaving> leaving;             // waits for an answer. Nothing: no question is asked
  SceneStats stats;                           // of the scene
  std::shared_ptr<const Tracer> tracer;       // null: nothing is traced, or the tree is not built yet
  bool wants_tree = false;                    // also where frames trace nothing: pixels are inspected
  bool lights_changed = false;                // by the overlay
  bool drops_environment = false;             // by the overlay
  int material = 0;                           // shown in the panel Materials
  bool material_picked = false;               // in the picture: the panel's list is to scroll to it
  std::optional<MaterialEdit> material_edit;  // its new value, by the overlay
  std::optional<PixelReport> pixel;           // under the pointer. Nothing: the panel is closed
  std::optional<double> pixel_error;          // against the reference. Nothing: it is not complete
  std::optional<LightHistogram> histogram;  // of the picture. Nothing: no light is shown, or no panel Drawing
  FileList files;
  SceneParts parts;
  SavePlace save;
  bool is_over_limit = false;  // the file that was opened last was refused for its memory
  Settings drawn;              // resolved from `applied`
  History history;
  TimelineView timeline;
  PlaybackState playback;
  int samples = 0;    // gathered by the still camera
  bool idle = false;  // the picture is done: nothing is drawn until something changes

  SceneLoader::Progress loading;
  Messages messages;
  std::string legend;                         // what the channel's colours mean. Empty: the picture is shown
  ChannelRange shown_range;                   // of the channel that is shown
  std::string comparison;                     // with the reference, in words. Empty: there is none
  bool is_comparing = false;                  // the reference or the error is not complete
  std::vector<Action> requested;              // by keys and buttons
  std::string file_to_open;                   // requested. Empty: none
  int camera_to_show = -1;                    // requested, one of the scene's. -1: none
  UpAxis up_axis = UpAxis::y;                 // of the scene's file
  std::optional<UpAxis> up_axis_to_use;       // requested. Nothing: the same
  std::string variant;                        // of the file's materials. Empty: the file's usual ones
  std::optional<std::string> variant_to_use;  // requested. Nothing: the same
  std::vector<std::string> recent;            // scene files, newest first

  glm::ivec2 window_pixels{0, 0}, picture_size{0, 0};
  PictureZoom zoom;
  PanelPlaces places;
  std::string settings_search;  // in the panel All settings
  std::string recording;        // name of the sequence that is written. Empty: none
  Image<glm::vec4> numbers;     // the picture's light, where pixels are enlarged enough. Empty: they are not
  std::string renderer;         // OpenGL's, in words
  int threads = 0;              // of the tracer
  std::string given_up;         // for the budget while the scene or camera moves, in words. Empty: nothing
  bool is_cheaper = false;      // the picture shown is without what is given up
  bool all_warnings = false;    // each warning is shown, not the first alone

  [[nodiscard]] bool has_scene() const { return !scene.source.empty(); }
  [[nodiscard]] bool is_loading() const { return !loading.phase.empty(); }
  // Whether a still camera's samples are gathered: channels and comparisons show one sample.
  [[nodiscard]] bool gathers() const {
    return applied.accumulate && applied.buffer == Layer::picture && applied.split == Split::off &&
           !applied.wireframe;
  }
  // Another size of the window ends the enlargement: its place would be another one.
  void set_window_pixels(glm::ivec2 pixels);
  // Whether pixels are enlarged so far that their values can be read on them.
  [[nodiscard]] bool wants_numbers() const;
  // The size of the picture for the window, pixels.
  [[nodiscard]] glm::ivec2 wanted_size() const;
  // The frame that shows all this, sampled at the pixels' centres.
  [[nodiscard]] FrameRequest request() const;
};

}  // namespace pinocchio::app
