#include "hybrid/raytrace.h"

#include "core/reference/reference.h"
#include "core/trace/view_params.h"
#include "hybrid/trace_answer.h"

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
  const TraceJob job = trace_job(request, view_of(request), workers);
  {
    const StageTimer timer(record, Stage::raster);
    picture.ids = Image<std::uint32_t>(request.part.size());
    record.rays += trace_visibility(job, picture.ids);
  }
  trace_answer(request, job.view, workers, picture.ids, picture.mask, picture.reflection, record);
  {
    const StageTimer timer(record, Stage::composite);
    shade(job, picture.ids, picture.mask, picture.reflection, picture.color);
  }
  record.frame.end_s = now_s();
  return record;
}

}  // namespace pinocchio
