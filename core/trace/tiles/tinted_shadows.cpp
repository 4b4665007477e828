#include "core/trace/tiles/tinted_shadows.h"

#include <algorithm>

#include "core/trace/rays/passed_surfaces.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

glm::vec3 vector_at(float* const (&columns)[3], std::size_t i) {
  return {columns[0][i], columns[1][i], columns[2][i]};
}

// Whether rays of this reach end at their light. The light of others is infinitely far away.
bool end_at_light(float reach) {
  return reach == 1.0f;
}

}  // namespace

bool passes_light(const Mesh& mesh, const Material& material, const TraceOptions& options) {
  return (options.glass_shadows == GlassShadows::tinted && material.transmits()) ||
         (material.maps >= 0 && mesh.maps[as_size(material.maps)].blends());
}

bool tints_shadows(const Mesh& mesh, const TraceOptions& options) {
  return std::ranges::any_of(mesh.materials,
                             [&](const Material& m) { return passes_light(mesh, m, options); });
}

// Most rays meet nothing, or something that stops them: the others are walked, and those whose light is in
// the medium with them.
RayQueue& TintedShadows::begin(const Tracer& tracer, const PassedSurfaces& passed, const RayQueue& rays,
                               float reach, std::uint8_t* blocked) {
  tracer.occluded(rays.columns(reach), rays.size, blocked, &passed);
  on_.make_room(rays.size, {.medium = rays.medium != nullptr});
  is_tinted_.clear();
  lit_.clear();
  for (std::size_t i = 0; i < rays.size; ++i) {
    const bool absorbed = end_at_light(reach) && rays.medium && rays.medium[i] != kNoMedium;
    if (blocked[i] != kMayPass && (blocked[i] != 0 || !absorbed)) continue;
    blocked[i] = 1;
    copy_ray(rays, i, on_, on_.size);
    on_.pixel[on_.size++] = as_uint32(i);
    is_tinted_.push_back(absorbed ? 1 : 0);
  }
  return on_;
}

// Keeps the rays that have neither reached their light nor lost all of theirs.
void TintedShadows::keep_going(const std::uint32_t* holes, float least, std::uint8_t* blocked) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < on_.size; ++k) {
    const glm::vec3 light = vector_at(on_.light, k);
    const std::uint32_t from = on_.pixel[k];
    if (on_.triangle[k] == kNoTriangle) {
      if (is_tinted_[k])
        lit_.push_back({from, light});
      else
        blocked[from] = 0;
      continue;
    }
    const bool is_tinted = is_tinted_[k] != 0 || holes[k] == 0;
    const float most = std::max({light.x, light.y, light.z});
    if (is_tinted && !(most > 0.0f && most >= least)) continue;
    copy_ray(on_, k, on_, kept);
    on_.pixel[kept] = from;
    is_tinted_[kept++] = is_tinted ? 1 : 0;
  }
  on_.size = kept;
}

void TintedShadows::go_on(const Tracer& tracer, const Bounce& bounce, float reach, std::uint8_t* blocked) {
  for (int layer = 0; on_.size > 0 && layer < kMostLayers; ++layer) {
    tracer.closest_hits(on_.columns(reach), on_.size, on_.triangle);
    const std::uint32_t* const holes = met_.find(tracer, bounce, on_);
    tracer.steps().cross_glass(bounce, holes, end_at_light(reach), on_);
    keep_going(holes, bounce.options->throughput_cutoff, blocked);
  }
}

}  // namespace pinocchio
