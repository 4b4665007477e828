#include "hybrid/plan.h"

#include <nlohmann/json.hpp>
#include <string>

#include "core/trace/mask_image.h"

namespace pinocchio {

Expected<Plan> make_plan(const Needs& needs, Mode mode, int depth) {
  if (needs.casting_lights > kMaxCastingLights)
    return Unexpected(InputError{{},
                                 0,
                                 "the scene has " + std::to_string(needs.casting_lights) +
                                     " lights that cast shadows, the shadow mask holds " +
                                     std::to_string(kMaxCastingLights),
                                 "let some not cast (extras.pinocchio.castsShadow, or "
                                 "--light x,y,z,intensity,nocast)"});
  Plan plan;
  plan.mode = mode;
  plan.id_bits = needs.triangles < 0xffffu ? 16 : 32;
  if (mode == Mode::raster) return plan;
  plan.mask_bits = MaskImage::bits_for(needs.casting_lights);
  plan.depth = needs.mirrors ? depth : 0;
  plan.reflection = plan.depth > 0;
  return plan;
}

const char* mode_name(Mode mode) {
  switch (mode) {
    case Mode::hybrid:
      return "hybrid";
    case Mode::raytrace:
      return "raytrace";
    case Mode::raster:
      return "raster";
  }
  return "";
}

nlohmann::json to_json(const Plan& plan) {
  nlohmann::json json{{"mode", mode_name(plan.mode)}, {"mask_bits", plan.mask_bits}, {"depth", plan.depth}};
  json["reflection"] = plan.reflection ? "half" : "none";
  if (plan.mode == Mode::hybrid) json["id_bits"] = plan.id_bits;
  return json;
}

}  // namespace pinocchio
