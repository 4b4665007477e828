#include "hybrid/plan.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/trace/mask_image.h"
#include "hybrid/formats.h"
#include "hybrid/reflection_tiles.h"

namespace pinocchio {
namespace {

constexpr std::size_t kMost16BitIds = 0xffff, kMost24BitIds = 0xffffff;  // one value less, as "none" is one

// A software rasteriser takes about as long for this many triangles as the tracer's primary rays for a
// pixel (docs/measurements.md, "Who finds what is seen").
constexpr double kTrianglesPerPixelForRays = 2.0;

Unexpected refused(const std::string& what, const std::string& remedy) {
  return Unexpected(InputError{{}, 0, what, remedy});
}

Expected<void> check_lights(const Needs& needs) {
  if (needs.casting_lights <= kMaxCastingLights) return {};
  return refused("the scene has " + std::to_string(needs.casting_lights) +
                     " lights that cast shadows, the shadow mask holds " + std::to_string(kMaxCastingLights),
                 "let some not cast (extras.pinocchio.castsShadow, or --light x,y,z,intensity,nocast)");
}

std::size_t most_ids(int id_bits) {
  return id_bits == 16 ? kMost16BitIds : id_bits == 24 ? kMost24BitIds : 0xffffffffu;
}

void plan_slides(const PlanRequest& request, Plan& plan) {
  plan.mask_bits = 8;
  plan.reflection = ReflectionFormat::rgb8;
  plan.reuse = false;
  plan.id_bits = request.design == 1 ? 24 : 32;
  plan.normals = request.design == 1;
  plan.wide = request.design == 2;
}

// Design 1's ways of sending less.
void plan_exchange(const Needs& needs, const PlanRequest& request, Plan& plan) {
  plan.tiles = plan.reflects();
  const double pixels = static_cast<double>(request.size.x) * static_cast<double>(request.size.y);
  const bool faster_by_rays = static_cast<double>(needs.triangles) > kTrianglesPerPixelForRays * pixels;
  if (request.software_gl && !request.reprojects && plan.traces() && faster_by_rays)
    plan.primary = Primary::rays;
}

bool is_scale(int scale) {
  return scale == 1 || scale == 2 || scale == 4;
}

Expected<void> check_design1_settings(const Plan& plan) {
  const bool any = plan.primary != Primary::raster || plan.mask_scale != 1 || plan.reflection_scale != 1 ||
                   plan.tiles || plan.normals;
  if (any && (plan.mode != Mode::hybrid || plan.design != 1))
    return refused(
        "primary \"rays\", mask_scale, reflection_scale, tiles and normals are hybrid design 1's alone",
        "leave them out, or set mode \"hybrid\" and design 1");
  if (plan.wide && (plan.mode != Mode::hybrid || plan.design != 2))
    return refused("wide is hybrid design 2's alone", "leave it out, or set design 2");
  return {};
}

}  // namespace

int bytes_per_pixel(ReflectionFormat format) {
  constexpr std::array<int, 5> kBytes{0, 3, 4, 6, 12};
  return kBytes[static_cast<std::size_t>(format)];
}

Expected<Plan> make_plan(const Needs& needs, const PlanRequest& request) {
  if (const Expected<void> checked = check_lights(needs); !checked) return Unexpected(checked.error());
  Plan plan;
  plan.mode = request.mode;
  plan.design = request.design;
  plan.threads = request.threads;
  plan.precise = request.precise && request.mode == Mode::raytrace;
  plan.id_bits = needs.triangles < kMost16BitIds ? 16 : 32;
  if (request.mode == Mode::raster) return plan;

  plan.mask_bits = MaskImage::bits_for(needs.casting_lights);
  plan.depth = needs.mirrors ? std::min(request.depth, needs.useful_depth) : 0;
  if (plan.depth > 0) plan.reflection = ReflectionFormat::half;
  if (request.slides && request.mode == Mode::hybrid) {
    plan_slides(request, plan);
    if (needs.triangles >= most_ids(plan.id_bits))
      return refused("the scene has " + std::to_string(needs.triangles) +
                         " triangles, the slides' 24-bit ids name " + std::to_string(kMost24BitIds - 1),
                     "use --plan auto");
    return plan;
  }
  // All lights together stay below half a step.
  if (!request.keeps_mask && !plan.precise)
    plan.least_light = kLeastContribution / static_cast<float>(std::max(needs.casting_lights, 1));
  if (request.mode == Mode::hybrid && request.design == 1) plan_exchange(needs, request, plan);
  return plan;
}

Expected<void> check_plan(const Plan& plan, const Needs& needs) {
  if (const Expected<void> checked = check_lights(needs); !checked) return checked;
  if (plan.design != 1 && plan.design != 2) return refused("design is not 1 or 2", "choose one of them");
  if (plan.id_bits != 16 && plan.id_bits != 24 && plan.id_bits != 32)
    return refused("id_bits is not 16, 24 or 32", "choose one of them");
  if (needs.triangles >= most_ids(plan.id_bits))
    return refused("id_bits " + std::to_string(plan.id_bits) + " cannot name the scene's " +
                       std::to_string(needs.triangles) + " triangles",
                   "use more bits");
  const int bits = plan.mask_bits;
  if (bits != 0 && bits != 1 && bits != 2 && bits != 4 && bits != 8)
    return refused("mask_bits is not 0, 1, 2, 4 or 8", "choose one of them");
  if (bits != 0 && bits < needs.casting_lights)
    return refused("mask_bits " + std::to_string(bits) + " cannot hold the scene's " +
                       std::to_string(needs.casting_lights) + " casting lights",
                   "use more bits, or 0 for no shadows");
  if (!is_scale(plan.mask_scale) || !is_scale(plan.reflection_scale))
    return refused("mask_scale or reflection_scale is not 1, 2 or 4", "choose one of them");
  if (plan.depth < 0 || plan.depth > kMostBounces)
    return refused("depth is not between 0 and " + std::to_string(kMostBounces), "choose one between them");
  if (plan.threads < 0 || plan.threads > kMostThreads)
    return refused("threads is not between 0 and " + std::to_string(kMostThreads), "0 means all cores");
  if (!std::isfinite(plan.least_contribution) || !std::isfinite(plan.least_light) ||
      plan.least_contribution < 0.0f || plan.least_light < 0.0f)
    return refused("least_contribution or least_light is negative", "0 means that every ray is fired");
  return check_design1_settings(plan);
}

TrafficBytes traffic_of(const Plan& plan, glm::ivec2 size) {
  if (plan.mode != Mode::hybrid || !plan.traces()) return {};
  const auto pixels_of = [](glm::ivec2 s) {
    return static_cast<std::size_t>(s.x) * static_cast<std::size_t>(s.y);
  };
  const std::size_t pixels = pixels_of(size);
  constexpr std::size_t kRgb8 = 3, kWide = 16;
  const auto id_bytes = static_cast<std::size_t>(plan.id_bits / 8);
  if (plan.design == 2) return {pixels * ((plan.wide ? kWide : id_bytes) + kRgb8), pixels * kRgb8};
  TrafficBytes traffic;
  if (plan.primary == Primary::raster) {
    traffic.to_cpu = pixels * (id_bytes + (plan.normals ? kRgb8 : 0));
  } else {
    traffic.to_gpu = pixels * id_bytes;
  }
  const glm::ivec2 mask = scaled_size(size, plan.mask_scale);
  traffic.to_gpu += static_cast<std::size_t>(MaskImage::row_bytes_for(mask.x, plan.mask_bits)) *
                    static_cast<std::size_t>(mask.y);
  const glm::ivec2 reflection = scaled_size(size, plan.reflection_scale);
  traffic.to_gpu += plan.tiles
                        ? most_tile_bytes(reflection, plan.reflection)
                        : pixels_of(reflection) * static_cast<std::size_t>(bytes_per_pixel(plan.reflection));
  return traffic;
}

const char* mode_name(Mode mode) {
  return kModeNames[static_cast<std::size_t>(mode)].data();
}

}  // namespace pinocchio
