#pragma once

#include <string>
#include <vector>

#include "app/named_files.h"
#include "app/options.h"
#include "pinocchio/camera.h"

namespace pinocchio::app {

// A frame of an animation and the camera it is seen by.
struct CameraFrame {
  int number = 0;
  Camera camera;
};

// --frames, --turntable, --path
struct AnimationOptions {
  std::string frames;  // A-B[xSTEP]
  int turntable = 0;   // frames once around the target; 0: none
  std::string path;    // JSON file of key frames
};

void add_animation_options(CLI::App& verb, AnimationOptions& options);

// The frames that the options ask for, in order; one, number 0, where they ask for none. Ends the verb
// with kUsage where the options contradict each other or the path cannot be read.
[[nodiscard]] std::vector<CameraFrame> animate(const AnimationOptions& options, const Camera& camera);

// Everything that drawing the scene by these options reads.
[[nodiscard]] std::vector<NamedFile> input_files(const DrawOptions& draw, const AnimationOptions& animation,
                                                 const Scene& scene);

}  // namespace pinocchio::app
