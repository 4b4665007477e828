#include "hybrid/trace_answer.h"

#include "core/trace/view_params.h"
#include "hybrid/formats.h"

namespace pinocchio {
namespace {

// Every scale-th id, across and down; `store` holds them where they are not all of them.
const Image<std::uint32_t>& sampled(const Image<std::uint32_t>& ids, int scale, Image<std::uint32_t>& store) {
  if (scale == 1) return ids;
  store = Image<std::uint32_t>(scaled_size(ids.size(), scale));
  for (int y = 0; y < store.size().y; ++y)
    for (int x = 0; x < store.size().x; ++x) store.at(x, y) = ids.at(x * scale, y * scale);
  return store;
}

}  // namespace

TraceJob trace_job(const FrameRequest& request, const shared::ViewParams& view, Workers& workers, int scale) {
  return {request.scene->scene,     request.scene->required_tracer(), workers,
          scaled_view(view, scale), request.plan.least_contribution,  request.plan.least_light};
}

void trace_answer(const FrameRequest& request, const shared::ViewParams& view, Workers& workers,
                  const Image<std::uint32_t>& ids, MaskImage& mask, Image<glm::vec3>& reflection,
                  FrameRecord& record) {
  const Plan& plan = request.plan;
  Image<std::uint32_t> store;
  LitCells* const cells = plan.reuse && plan.mask_bits > 0 ? request.scene->lit_cells() : nullptr;
  const auto job = [&](int scale) {
    TraceJob with_cells = trace_job(request, view, workers, scale);
    with_cells.cells = cells;
    return with_cells;
  };
  if (plan.mask_bits > 0) {
    const StageTimer timer(record, Stage::trace_shadow);
    record.rays +=
        trace_shadow_mask(job(plan.mask_scale), sampled(ids, plan.mask_scale, store), plan.mask_bits, mask);
  }
  if (plan.reflects()) {
    const StageTimer timer(record, Stage::trace_reflection);
    record.rays += trace_reflection(job(plan.reflection_scale), sampled(ids, plan.reflection_scale, store),
                                    plan.depth, reflection);
  }
}

MaskImage enlarged(const MaskImage& mask, int scale, glm::ivec2 size) {
  MaskImage large(size, mask.bits());
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      for (unsigned bits = mask.get(x / scale, y / scale), slot = 0; bits >> slot != 0; ++slot)
        if (bits >> slot & 1u) large.set_bit(x, y, static_cast<int>(slot));
  return large;
}

Image<glm::vec3> enlarged(const Image<glm::vec3>& image, int scale, glm::ivec2 size) {
  Image<glm::vec3> large(size);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) large.at(x, y) = image.at(x / scale, y / scale);
  return large;
}

}  // namespace pinocchio
