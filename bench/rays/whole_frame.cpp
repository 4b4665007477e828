#include "bench/rays/whole_frame.h"

#include <algorithm>
#include <map>
#include <utility>

#include "bench/rays/measure.h"
#include "core/math/median.h"
#include "core/trace/trace_tiles.h"
#include "core/trace/view_params.h"

namespace pinocchio::bench {
namespace {

constexpr int kDepth = 8;

// One way to draw the frame, into images of its own.
class Drawing {
 public:
  Drawing(const TraceJob& job, glm::ivec2 size, const Image<std::uint32_t>* seen) : job_(job) {
    out_.size = size;
    out_.seen = seen;
    out_.mask_bits = MaskImage::bits_for(static_cast<int>(casting_lights(job.scene).size()));
    out_.mask = &mask_;
    out_.depth = kDepth;
    out_.reflection = &reflection_;
    if (seen) return;
    out_.ids = &ids;
    out_.color = &color_;
  }

  void draw() { trace_tiles(job_, out_); }

  // The frame's rays by generation and kind, each in the order in which they are traced on one thread.
  [[nodiscard]] std::vector<RaySet> rays() {
    std::map<std::pair<int, bool>, RaySet> sets;
    out_.on_rays = [&](const RayBatch& batch) {
      RaySet& set = sets[{batch.generation, batch.shadow}];
      set.query = batch.shadow ? Query::any : Query::closest;
      const RayColumns& c = batch.rays;
      for (std::size_t i = 0; i < batch.count; ++i)
        set.rays.push_back({{c.origin[0][i], c.origin[1][i], c.origin[2][i]},
                            c.reach,
                            {c.direction[0][i], c.direction[1][i], c.direction[2][i]}});
    };
    draw();
    out_.on_rays = nullptr;
    std::vector<RaySet> all;
    for (auto& [key, set] : sets) all.push_back(std::move(set));
    return all;
  }

  Image<std::uint32_t> ids;

 private:
  TraceJob job_;
  TileOutputs out_;
  MaskImage mask_;
  Image<glm::vec3> reflection_;
  Image<glm::vec4> color_;
};

// Seconds of Embree for a set, its two ways apart.
struct Times {
  std::vector<double> single, packets;
  [[nodiscard]] double best_ms() const { return 1e3 * std::min(median(single), median(packets)); }
};

}  // namespace

std::vector<WholeFrame> measure_frames(const Scene& scene, const Tracer& tracer, const EmbreeSide& embree,
                                       glm::ivec2 size, const std::vector<Workers*>& on, int repeat) {
  const Camera camera = scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
  const shared::ViewParams view = view_params(camera, size);
  Workers one(1);
  std::vector<RaySet> sets = Drawing({scene, tracer, one, view}, size, nullptr).rays();
  const auto single = embree.single(), packets = embree.packets();

  std::vector<WholeFrame> frames;
  for (Workers* workers : on) {
    const TraceJob job{scene, tracer, *workers, view};
    Drawing raytrace(job, size, nullptr), hybrid(job, size, &raytrace.ids);
    std::vector<double> raytrace_s, hybrid_s;
    std::vector<Times> theirs(sets.size());
    for (int i = 0; i <= repeat; ++i) {  // one more: the first
      raytrace_s.push_back(seconds_of([&] { raytrace.draw(); }));
      hybrid_s.push_back(seconds_of([&] { hybrid.draw(); }));
      for (std::size_t k = 0; k < sets.size(); ++k) {
        theirs[k].single.push_back(seconds_of_tracing(*single, sets[k], *workers));
        theirs[k].packets.push_back(seconds_of_tracing(*packets, sets[k], *workers));
      }
    }
    WholeFrame all{"raytrace", workers->count(), std::string(isa_name(tracer.isa()))};
    WholeFrame traced = all;
    traced.mode = "hybrid";
    for (std::size_t k = 0; k < sets.size(); ++k) {
      const bool camera_rays = k == 0;
      for (WholeFrame* frame : {&all, &traced}) {
        if (frame == &traced && camera_rays) continue;
        frame->rays += sets[k].rays.size();
        frame->embree_rays_ms += theirs[k].best_ms();
      }
    }
    for (const auto& [frame, times] : {std::pair(&all, &raytrace_s), std::pair(&traced, &hybrid_s)}) {
      frame->first_ms = 1e3 * times->front();
      frame->ours_ms = 1e3 * median(std::vector(times->begin() + 1, times->end()));
      frames.push_back(*frame);
    }
  }
  return frames;
}

}  // namespace pinocchio::bench
