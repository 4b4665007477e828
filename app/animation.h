#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/named_files.h"
#include "app/options.h"
#include "pinocchio/camera.h"

namespace pinocchio::app {

// A frame of an animation: when it is, and the camera it is seen by.
struct CameraFrame {
  int number = 0;
  Camera camera;
  double time_s = 0.0;  // of the scene's own animation
};

inline constexpr int kUsualFps = 24;

// --frames, --turntable, --path, --time, --fps
struct AnimationOptions {
  std::string frames;  // A-B[xSTEP]
  int turntable = 0;   // frames once around the target; 0: none
  std::string path;    // JSON file of key frames
  std::optional<double> time_s;  // of all frames; else frame n's is n / fps
  int fps = kUsualFps;

  [[nodiscard]] double time_of(int frame) const {
    return time_s.value_or(static_cast<double>(frame) / static_cast<double>(fps));
  }
};

void add_animation_options(CLI::App& verb, AnimationOptions& options);

// The frames that the options ask for, in order; one, number 0, where they ask for none. The scene's own camera
// moves with its node, where no path says where it is. Ends the verb with kUsage where the options contradict
// each other or the path cannot be read.
[[nodiscard]] std::vector<CameraFrame> animate(const AnimationOptions& options, const DrawOptions& draw, const Scene& scene);

// Everything that drawing the scene by these options reads.
[[nodiscard]] std::vector<NamedFile> input_files(const DrawOptions& draw, const AnimationOptions& animation,
                                                 const Scene& scene);

}  // namespace pinocchio::app
