#pragma once

#include <string>

#include "app/window/overlay/gui.h"
#include "app/window/screen/pace.h"
#include "app/window/screen/split_view.h"
#include "hybrid/inspect/histogram_pass.h"
#include "hybrid/inspect/present_pass.h"

namespace pinocchio::app {

// What the window shows: the picture, the reference in its right half, and the overlay over both.
class Screen {
 public:
  static constexpr double kBetweenRedraws_s = 0.025;  // while a scene is loaded
  static constexpr int kSettling = 3;                 // redraws until panels that size themselves stand still

  Screen(gl::Window& window, Engine& engine, Model& model, const SplitView& split);

  [[nodiscard]] Gui& gui() { return gui_; }
  [[nodiscard]] Pace& pace() { return pace_; }
  [[nodiscard]] const Pace& pace() const { return pace_; }

  // The picture to show from now on, which the caller keeps. Null: there is none. is_light: exposure and tone
  // curve are applied to it.
  void set_picture(const gl::Texture* picture, bool is_light = true);
  [[nodiscard]] bool has_picture() const { return picture_ != nullptr; }
  // The overlay is drawn at least `times` times more, whether or not there is a new picture.
  void request_redraw(int times = kSettling) { redraws_ = std::max(redraws_, times); }
  [[nodiscard]] int redraws() const { return redraws_; }
  // Whether something changed that does not wait for a frame: panels, exposure, the progress of loading.
  [[nodiscard]] bool wants_redraw() const;
  // Until the next redraw while a scene is loaded, seconds.
  [[nodiscard]] double until_redraw_s() const;

  void begin_turn() { shown_ = false; }
  [[nodiscard]] bool shown() const { return shown_; }  // something, since begin_turn()
  void show();
  // The picture, without the overlay, as the display would show it.
  [[nodiscard]] Image<glm::u8vec3> read_picture();
  // Writes the window to this file when it is drawn next: with what is over the picture, or without.
  void save_next(const std::string& png, bool with_overlay) {
    png_file_ = png;
    with_overlay_ = with_overlay;
  }

  // Counts the picture's light for the panel Drawing: twice a second, and once of the finished picture.
  void count_light();

 private:
  void draw_picture();
  [[nodiscard]] Image<glm::u8vec3> read_pixels() const;
  void write_png_file();

  gl::Window& window_;
  Model& model_;
  const SplitView& split_;
  Gui gui_;
  PresentPass present_;
  HistogramPass histogram_;
  Pace pace_;

  const gl::Texture* picture_ = nullptr;
  bool is_light_ = true;
  bool counted_ = false;  // the light of picture_
  double counted_s_ = 0.0;
  bool shown_ = false;
  int redraws_ = kSettling;
  double redrawn_s_ = 0.0;
  std::string png_file_;  // empty: none is to be written
  bool with_overlay_ = false;
};

}  // namespace pinocchio::app
