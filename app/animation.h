#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/camera_path.h"
#include "app/named_files.h"
#include "app/options.h"
#include "app/parse.h"
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
  std::string frames;            // A-B[xSTEP]
  int turntable = 0;             // frames once around the target; 0: none
  std::string path;              // JSON file of key frames
  std::optional<double> time_s;  // of all frames; else frame n's is n / fps
  int fps = kUsualFps;

  [[nodiscard]] double time_of(int frame) const {
    return time_s.value_or(static_cast<double>(frame) / static_cast<double>(fps));
  }
};

void add_animation_options(CLI::App& verb, AnimationOptions& options);

// The frames that the options ask for, in order; one, number 0, where they ask for none. Each is made when it
// is asked for: of a range of any length, only the key frames are kept. The scene's own camera moves with its
// node, where no path says where it is.
class CameraFrames {
 public:
  // Keeps `draw`. Ends the verb with kUsage where the options contradict each other, the path cannot be read,
  // or eye and target meet on it.
  CameraFrames(AnimationOptions options, const DrawOptions& draw, Scene scene);

  [[nodiscard]] std::size_t size() const { return range_.count(); }
  [[nodiscard]] const FrameRange& range() const { return range_; }
  [[nodiscard]] CameraFrame operator[](std::size_t i) const;
  // All frames', where it stands still.
  [[nodiscard]] std::optional<Camera> only_camera() const;

 private:
  [[nodiscard]] Camera camera_of(int number, double time_s) const;
  [[noreturn]] void refuse_meeting(int number) const;

  AnimationOptions options_;
  const DrawOptions& draw_;
  Scene scene_;
  CameraPath path_;
  FrameRange range_;
};

// Everything that drawing the scene by these options reads.
[[nodiscard]] std::vector<NamedFile> input_files(const DrawOptions& draw, const AnimationOptions& animation,
                                                 const Scene& scene);

}  // namespace pinocchio::app
