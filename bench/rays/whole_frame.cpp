#include "bench/rays/whole_frame.h"

#include <algorithm>
#include <utility>

#include "bench/rays/sides/drawing.h"
#include "bench/rays/sides/measure.h"
#include "bench/rays/texture_samples.h"
#include "core/math/median.h"

namespace pinocchio::bench {
namespace {

// Embree's seconds for a set, for each of its two ways.
struct Times {
  std::vector<double> single, packets;
  [[nodiscard]] double best_ms() const { return 1e3 * std::min(median(single), median(packets)); }
};

}  // namespace

std::vector<WholeFrame> measure_frames(const Scene& scene, const Tracer& tracer, const EmbreeSide& embree,
                                       glm::ivec2 size, const std::vector<Workers*>& on, int repeat,
                                       bool clear_ways) {
  const shared::ViewParams view = first_view(scene, size);
  const std::vector<RaySet> sets = frame_ray_sets(scene, tracer, size);
  const TextureSamples textures(scene, tracer, view, sets);
  const auto single = embree.single(), packets = embree.packets();

  // As the engine has it, where the mask is not kept.
  const float cutoff = light_cutoff_of(as_int(casting_lights(scene).size()));

  std::vector<WholeFrame> frames;
  for (Workers* workers : on) {
    TraceJob job{scene, tracer, *workers, view};
    job.options.light_cutoff = cutoff;
    job.options.clear_ways = clear_ways;
    Drawing raytrace(job, size), hybrid(job, size, &raytrace.ids);
    std::vector<double> raytrace_s, hybrid_s, textures_s;
    std::vector<Times> theirs(sets.size());
    for (int i = 0; i <= repeat; ++i) {  // one more, for the first frame
      raytrace_s.push_back(seconds_of([&] { raytrace.draw(); }));
      hybrid_s.push_back(seconds_of([&] { hybrid.draw(); }));
      textures_s.push_back(textures.seconds(*workers));
      for (std::size_t k = 0; k < sets.size(); ++k) {
        theirs[k].single.push_back(seconds_of_tracing(*single, sets[k], *workers));
        theirs[k].packets.push_back(seconds_of_tracing(*packets, sets[k], *workers));
      }
    }
    WholeFrame all{"raytrace", workers->count(), std::string(isa_name(tracer.isa()))};
    WholeFrame traced = all;
    traced.mode = "hybrid";
    for (std::size_t k = 0; k < sets.size(); ++k) {
      const bool camera_rays = sets[k].name == "primary";
      for (WholeFrame* frame : {&all, &traced}) {
        if (frame == &traced && camera_rays) continue;
        frame->rays += sets[k].rays.size();
        frame->embree_rays_ms += theirs[k].best_ms();
      }
    }
    for (const auto& [frame, times] : {std::pair(&all, &raytrace_s), std::pair(&traced, &hybrid_s)}) {
      frame->first_ms = 1e3 * times->front();
      frame->ours_ms = 1e3 * median(std::vector(times->begin() + 1, times->end()));
      frame->textures_ms = 1e3 * median(textures_s);
      frames.push_back(*frame);
    }
  }
  return frames;
}

}  // namespace pinocchio::bench
