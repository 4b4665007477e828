#include "hybrid/raytrace.h"

#include "core/reference/reference.h"
#include "core/trace/view.h"

namespace pinocchio {
namespace {

shared::ViewParams view_of(const FrameRequest& request) {
  return view_params(request.camera, request.size, request.jitter, request.part.lo);
}

FrameRecord raytrace_precise(const FrameRequest& request, Workers& workers, Picture& picture) {
  FrameRecord record;
  record.frame.begin_s = now_s();
  {
    const StageTimer timer(record, Stage::composite);
    picture.ids = Image<std::uint32_t>(request.part.size());
    reference_picture(request.scene->scene, workers, view_of(request), request.plan.depth, picture.ids,
                      picture.mask, picture.reflection, picture.color);
  }
  record.frame.end_s = now_s();
  return record;
}

}  // namespace

FrameRecord raytrace(const FrameRequest& request, Workers& workers, Picture& picture) {
  if (request.plan.precise) return raytrace_precise(request, workers, picture);
  FrameRecord record;
  record.frame.begin_s = now_s();
  const Plan& plan = request.plan;
  const TraceJob job{request.scene->scene, request.scene->required_tracer(), workers, view_of(request)};
  {
    const StageTimer timer(record, Stage::raster);
    picture.ids = Image<std::uint32_t>(request.part.size());
    record.rays += trace_visibility(job, picture.ids);
  }
  if (plan.mask_bits > 0) {
    const StageTimer timer(record, Stage::trace_shadow);
    record.rays += trace_shadow_mask(job, picture.ids, plan.mask_bits, picture.mask);
  }
  if (plan.reflects()) {
    const StageTimer timer(record, Stage::trace_reflection);
    record.rays += trace_reflection(job, picture.ids, plan.depth, picture.reflection);
  }
  {
    const StageTimer timer(record, Stage::composite);
    shade(job, picture.ids, picture.mask, picture.reflection, picture.color);
  }
  record.frame.end_s = now_s();
  return record;
}

}  // namespace pinocchio
