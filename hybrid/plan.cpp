#include "hybrid/plan.h"

#include <nlohmann/json.hpp>
#include <string>

#include "core/trace/mask_image.h"

namespace pinocchio {
namespace {

constexpr std::size_t kMost16BitIds = 0xffff, kMost24BitIds = 0xffffff;  // one value less, as "none" is one

Expected<void> check_limits(const Needs& needs, const PlanRequest& request) {
  if (needs.casting_lights > kMaxCastingLights)
    return Unexpected(InputError{{},
                                 0,
                                 "the scene has " + std::to_string(needs.casting_lights) +
                                     " lights that cast shadows, the shadow mask holds " +
                                     std::to_string(kMaxCastingLights),
                                 "let some not cast (extras.pinocchio.castsShadow, or "
                                 "--light x,y,z,intensity,nocast)"});
  if (request.slides && needs.triangles >= kMost24BitIds)
    return Unexpected(InputError{{},
                                 0,
                                 "the scene has " + std::to_string(needs.triangles) +
                                     " triangles, the slides' 24-bit ids name " +
                                     std::to_string(kMost24BitIds - 1),
                                 "use --plan auto"});
  return {};
}

// What the scene asks for, whatever format it travels in.
void plan_passes(const Needs& needs, const PlanRequest& request, Plan& plan) {
  plan.mask_bits = MaskImage::bits_for(needs.casting_lights);
  plan.depth = needs.mirrors ? request.depth : 0;
  if (plan.depth > 0) plan.reflection = ReflectionFormat::half;
}

}  // namespace

Expected<Plan> make_plan(const Needs& needs, const PlanRequest& request) {
  if (const Expected<void> checked = check_limits(needs, request); !checked)
    return Unexpected(checked.error());
  Plan plan;
  plan.mode = request.mode;
  plan.design = request.design;
  plan.precise = request.precise && request.mode == Mode::raytrace;
  plan.id_bits = needs.triangles < kMost16BitIds ? 16 : 32;
  if (request.mode == Mode::raster) return plan;
  plan_passes(needs, request, plan);
  if (!request.slides || request.mode != Mode::hybrid) return plan;
  plan.mask_bits = 8;
  plan.reflection = ReflectionFormat::rgb8;
  if (request.design == 1) {
    plan.id_bits = 24;
    plan.normals = true;
  } else {
    plan.id_bits = 32;
    plan.wide = true;
  }
  return plan;
}

TrafficBytes traffic_of(const Plan& plan, glm::ivec2 size) {
  if (plan.mode != Mode::hybrid || !plan.traces()) return {};
  const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  constexpr std::size_t kRgb8 = 3, kHalfRgb = 6, kWide = 16;
  const auto id_bytes = static_cast<std::size_t>(plan.id_bits / 8);
  if (plan.design == 2) return {pixels * ((plan.wide ? kWide : id_bytes) + kRgb8), pixels * kRgb8};
  const std::size_t mask = static_cast<std::size_t>(MaskImage::row_bytes_for(size.x, plan.mask_bits)) *
                           static_cast<std::size_t>(size.y);
  const std::size_t reflection = plan.reflection == ReflectionFormat::none   ? 0
                                 : plan.reflection == ReflectionFormat::rgb8 ? kRgb8
                                                                             : kHalfRgb;
  return {pixels * (id_bytes + (plan.normals ? kRgb8 : 0)), mask + pixels * reflection};
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
  constexpr const char* kFormats[] = {"none", "rgb8", "half"};
  nlohmann::json json{{"mode", mode_name(plan.mode)}, {"mask_bits", plan.mask_bits}, {"depth", plan.depth}};
  json["reflection"] = kFormats[static_cast<int>(plan.reflection)];
  if (plan.precise) json["precise"] = true;
  if (plan.mode != Mode::hybrid) return json;
  json["design"] = plan.design;
  json["id_bits"] = plan.id_bits;
  json["normals"] = plan.normals;
  json["wide"] = plan.wide;
  return json;
}

}  // namespace pinocchio
