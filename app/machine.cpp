#include "app/machine.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/errors.h"
#include "core/image/atomic_file.h"
#include "gl/open.h"

namespace pinocchio::app {

Machine::Machine(const DrawOptions& options, Scene scene)
    : plan_(value_or_exit(make_plan(take_census(scene), options.mode, options.depth), kBadScene)),
      workers_(options.threads) {
  if (plan_.mode != Mode::raytrace)
    context_ =
        gl::open_context({options.backend, options.device, std::getenv("PINOCCHIO_GL_DEBUG") != nullptr});
  scene_ = std::make_shared<const PreparedScene>(std::move(scene), plan_, options.tree, options.isa);
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
