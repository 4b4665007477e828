#include "app/machine.h"

#include <cstdlib>

#include "app/errors.h"
#include "gl/open.h"
#include "hybrid/plan_json.h"

namespace pinocchio::app {

namespace {

// Before any context is opened: whether it will be a rasteriser of the CPU's makes no difference to whether
// there must be one.
Mode mode_of(const DrawOptions& options, const Needs& needs) {
  return options.plan_file.empty() ? options.mode
                                   : value_or_exit(load_plan(options.plan_file, needs), kUsage).mode;
}

std::unique_ptr<gl::Context> open_gl(const DrawOptions& options) {
  if (options.gl_threads > 0) setenv("LP_NUM_THREADS", std::to_string(options.gl_threads).c_str(), 1);
  return gl::open_context({options.backend, options.device, std::getenv("PINOCCHIO_GL_DEBUG") != nullptr});
}

}  // namespace

Machine::Machine(const DrawOptions& options, Scene scene, bool keeps_mask, bool all_sides)
    : options_(options),
      keeps_mask_(keeps_mask),
      needs_(take_census(scene)),
      context_(all_sides || mode_of(options, needs_) != Mode::raytrace ? open_gl(options) : nullptr) {
  plan_ = options.plan_file.empty() ? value_or_exit(make_plan(needs_, request()), kBadScene)
                                    : value_or_exit(load_plan(options.plan_file, needs_), kUsage);
  if (options.threads > 0) plan_.threads = options.threads;
  if (options.exchange == Exchange::reproject && plan_.mode == Mode::hybrid && plan_.design == 2)
    throw Exit(kUsage,
               "--exchange reproject: warps mask and reflection, which design 2 does not send; use design 1");
  workers_.emplace(plan_.threads);
  scene_ = std::make_shared<const PreparedScene>(std::move(scene), all_sides ? Sides{} : sides_of(plan_),
                                                 options.tree, options.isa, options.offset);
}

PlanRequest Machine::request() const {
  return {.mode = options_.mode,
          .design = options_.design,
          .depth = options_.depth,
          .slides = options_.slides,
          .precise = options_.precise,
          .threads = options_.threads,
          .software_gl = context_ && context_->info().software,
          .reprojects = options_.exchange == Exchange::reproject,
          .keeps_mask = keeps_mask_,
          .size = part_of(options_).size()};
}

PixelBox part_of(const DrawOptions& options) {
  const PixelBox whole{{0, 0}, options.size};
  if (!options.crop) return whole;
  const PixelBox part{glm::max(options.crop->lo, whole.lo), glm::min(options.crop->hi, whole.hi)};
  if (part.empty())
    throw Exit(kUsage, "--crop: no pixel of the picture is in the box; it is x0,y0,x1,y1, half-open");
  return part;
}

}  // namespace pinocchio::app
