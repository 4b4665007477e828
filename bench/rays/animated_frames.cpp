#include "bench/rays/animated_frames.h"

#include <cmath>
#include <cstdio>
#include <future>

#include "bench/rays/sides/measure.h"
#include "core/math/median.h"
#include "core/parallel/start_thread.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/animation.h"
#include "pinocchio/error.h"
#include "pinocchio/nodes.h"

namespace pinocchio::bench {
namespace {

struct Pose {
  Scene scene;
  std::shared_ptr<const Tracer> tracer;
};

// The whole scene rotates once around the world's Y in four seconds.
Scene turning(const Scene& scene) {
  const Part part{"all", scene, glm::mat4(1.0f)};
  Scene turned = assembled({&part, 1}).value();
  Animation animation;
  animation.duration_s = 4.0;
  Track track;
  track.path = Track::Path::rotation;
  track.width = 4;
  for (int k = 0; k <= 4; ++k) {
    const float half = glm::radians(45.0f * static_cast<float>(k));
    track.times_s.push_back(static_cast<float>(k));
    track.values.insert(track.values.end(), {0.0f, std::sin(half), 0.0f, std::cos(half)});
  }
  animation.nodes = {{0, {}, {track}}};
  turned.animation = std::make_shared<const Animation>(std::move(animation));
  return turned;
}

class Frames {
 public:
  Frames(const Scene& scene, const BuildOptions& options, glm::ivec2 size, int threads, int frames)
      : scene_(scene),
        options_(options),
        size_(size),
        workers_(threads),
        frames_(frames),
        camera_(scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front()) {}

  AnimatedFrames measure() {
    AnimatedFrames row;
    std::vector<double> pose_s, build_s, still_s, waited_s, overlapped_s;
    std::future<Pose> next = begin(0);
    for (int i = 0; i < frames_; ++i) {
      overlapped_s.push_back(seconds_of([&] {
        const Pose now = next.get();
        next = begin(i + 1);
        draw(now);
      }));
    }
    (void)next.get();
    for (int i = 0; i < frames_; ++i) {
      Scene posed;
      Pose now;
      pose_s.push_back(seconds_of([&] { posed = at_time(scene_, time_of(i)).value(); }));
      build_s.push_back(seconds_of([&] {
        now = {posed, std::make_shared<const Tracer>(posed.mesh, options_)};
      }));
      still_s.push_back(seconds_of([&] { draw(now); }));
      waited_s.push_back(pose_s.back() + build_s.back() + still_s.back());
    }
    row.tree = kSplitRuleNames[static_cast<std::size_t>(options_.rule)];
    row.pose_ms = 1e3 * median(pose_s);
    row.build_ms = 1e3 * median(build_s);
    row.still_ms = 1e3 * median(still_s);
    row.waited_ms = 1e3 * median(waited_s);
    row.overlapped_ms = 1e3 * median(overlapped_s);
    return row;
  }

 private:
  [[nodiscard]] double time_of(int frame) const {
    return duration_s(scene_) * static_cast<double>(frame) / static_cast<double>(frames_);
  }

  std::future<Pose> begin(int frame) {
    return run_aside(0, [this, frame] {
      Scene posed = at_time(scene_, time_of(frame)).value();
      auto tracer = std::make_shared<const Tracer>(posed.mesh, options_);
      return Pose{std::move(posed), std::move(tracer)};
    });
  }

  void draw(const Pose& pose) {
    TileOutputs out;
    out.size = size_;
    out.mask_bits = MaskImage::bits_for(static_cast<int>(casting_lights(pose.scene).size()));
    out.mask = &mask_;
    out.depth = kMostBounces;
    out.reflection = &reflection_;
    out.ids = &ids_;
    out.color = &color_;
    trace_tiles({pose.scene, *pose.tracer, workers_, view_params(camera_, size_)}, out);
  }

  static constexpr int kMostBounces = 8;
  const Scene& scene_;
  const BuildOptions& options_;
  glm::ivec2 size_;
  Workers workers_;
  int frames_;
  Camera camera_;
  MaskImage mask_;
  Image<glm::vec3> reflection_;
  Image<std::uint32_t> ids_;
  Image<glm::vec4> color_;
};

}  // namespace

std::vector<AnimatedFrames> measure_animated_frames(Scene scene, const BuildOptions& options, glm::ivec2 size,
                                                    int threads, int frames) {
  if (!scene.animation) scene = turning(scene);
  std::vector<AnimatedFrames> rows;
  for (const SplitRule rule : {SplitRule::sah, SplitRule::spatial_median, SplitRule::object_median}) {
    BuildOptions of_rule = options;
    of_rule.rule = rule;
    rows.push_back(Frames(scene, of_rule, size, threads, frames).measure());
  }
  return rows;
}

void print(const std::vector<AnimatedFrames>& rows) {
  std::printf("an animated scene, milliseconds a frame (lost: of the still scene's frame rate):\n");
  std::printf("%-16s %8s %8s %8s %10s %6s %12s %6s\n", "tree", "pose", "build", "still", "waited", "lost",
              "overlapped", "lost");
  for (const AnimatedFrames& r : rows)
    std::printf("%-16s %8.2f %8.2f %8.2f %10.2f %5.0f%% %12.2f %5.0f%%\n", r.tree.c_str(), r.pose_ms,
                r.build_ms, r.still_ms, r.waited_ms, 100.0 * r.lost(r.waited_ms), r.overlapped_ms,
                100.0 * r.lost(r.overlapped_ms));
}

}  // namespace pinocchio::bench
