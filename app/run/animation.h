#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/named_files.h"
#include "app/cli/options.h"
#include "app/cli/parse.h"
#include "app/run/camera_path.h"
#include "pinocchio/camera.h"

namespace pinocchio::app {

// A frame of an animation: its number, camera and time.
struct CameraFrame {
  int number = 0;
  Camera camera;
  double time_s = 0.0;  // of the scene's own animation
};

inline constexpr int kUsualFps = 24;

// --frames, --turntable, --path, --time, --fps
struct AnimationOptions {
  std::string frames;            // A-B[xSTEP]
  int turntable = 0;             // frames of one turn around the target. 0: none
  std::string path;              // JSON file of key frames
  std::optional<double> time_s;  // of all frames. Nothing: frame n is at n / fps
  int fps = kUsualFps;

  [[nodiscard]] double time_of(int frame) const { return time_s.value_or(1.0 * frame / fps); }
};

void add_animation_options(CLI::App& verb, AnimationOptions& options);

// The frames that the options describe, in order; one frame, number 0, where they describe none. A frame is
// computed on access, so that a range may be long. Without a path, the scene's camera moves with its node.
class CameraFrames {
 public:
  // Keeps `draw`. Ends the verb with kUsage where the options contradict each other, the path cannot be read,
  // or eye and target coincide on it.
  CameraFrames(AnimationOptions options, const DrawOptions& draw, Scene scene);

  [[nodiscard]] std::size_t size() const { return range_.count(); }
  [[nodiscard]] const FrameRange& range() const { return range_; }
  [[nodiscard]] CameraFrame operator[](std::size_t i) const;
  // The frame one step later than frame i, or earlier: also before the first and after the last one.
  [[nodiscard]] CameraFrame beside(std::size_t i, bool later) const;
  // The camera of all frames. Nothing: it moves.
  [[nodiscard]] std::optional<Camera> only_camera() const;

 private:
  [[nodiscard]] Camera camera_of(int number, double time_s) const;
  [[nodiscard]] CameraFrame frame_of(int number) const;
  [[noreturn]] void refuse_coincidence(int number) const;

  AnimationOptions options_;
  DrawOptions draw_;
  Scene scene_;
  CameraPath path_;
  FrameRange range_;
};

// The files that drawing the scene by these options reads.
[[nodiscard]] std::vector<NamedFile> input_files(const DrawOptions& draw, const AnimationOptions& animation,
                                                 const Scene& scene);

}  // namespace pinocchio::app
