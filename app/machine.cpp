#include "app/machine.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/errors.h"
#include "core/image/atomic_file.h"
#include "gl/open.h"

namespace pinocchio::app {

Machine::Machine(const DrawOptions& options, Scene scene, std::optional<Sides> sides)
    : plan_(value_or_exit(make_plan(take_census(scene), plan_request(options)), kBadScene)),
      workers_(options.threads) {
  const Sides wanted = sides.value_or(sides_of(plan_));
  if (wanted.gpu) {
    if (options.gl_threads > 0) setenv("LP_NUM_THREADS", std::to_string(options.gl_threads).c_str(), 1);
    context_ =
        gl::open_context({options.backend, options.device, std::getenv("PINOCCHIO_GL_DEBUG") != nullptr});
  }
  scene_ = std::make_shared<const PreparedScene>(std::move(scene), wanted, options.tree, options.isa,
                                                 options.offset);
}

PlanRequest plan_request(const DrawOptions& options) {
  if (options.exchange == Exchange::reproject && options.design == 2)
    throw Exit(
        kUsage,
        "--exchange reproject: warps mask and reflection, which design 2 does not send; use --design 1");
  return {options.mode, options.design, options.depth, options.slides, options.precise};
}

PixelBox part_of(const DrawOptions& options) {
  const PixelBox whole{{0, 0}, options.size};
  if (!options.crop) return whole;
  const PixelBox part{glm::max(options.crop->lo, whole.lo), glm::min(options.crop->hi, whole.hi)};
  if (part.empty())
    throw Exit(kUsage, "--crop: no pixel of the picture is in the box; it is x0,y0,x1,y1, half-open");
  return part;
}

void check_json(const std::filesystem::path& file) {
  check_writable(file);
}

void write_json(const std::filesystem::path& file, const nlohmann::json& json) {
  write_text(file, json.dump(2) + "\n");
}

}  // namespace pinocchio::app
