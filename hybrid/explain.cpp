#include "hybrid/explain.h"

#include <cmath>

namespace pinocchio {
namespace {

std::string plural(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::ceil(100.0 * share))) + " %";
}

std::string per_sample(int scale) {
  return scale == 1 ? ""
                    : ", one sample for " + std::to_string(scale) + "x" + std::to_string(scale) + " pixels";
}

bool on_gpu(const Plan& plan) {
  return plan.mode == Mode::hybrid && plan.design == 1;
}

std::string who_draws(const Plan& plan) {
  if (plan.mode == Mode::raytrace) return "the CPU draws alone; no OpenGL is opened";
  if (plan.mode == Mode::raster) return "the GPU draws alone";
  return plan.design == 1 ? "the GPU puts the picture together (design 1)"
                          : "the GPU finds what is seen, the CPU puts the picture together (design 2)";
}

std::string why_primary(const Needs& needs, const Plan& plan) {
  const std::string triangles = std::to_string(needs.triangles) + " triangles to name";
  const std::string bits = std::to_string(plan.id_bits) + " bits";
  if (!plan.traces()) return "the GPU finds what is seen, and ids stay there: nothing is left for the CPU";
  if (plan.primary == Primary::rays)
    return "the CPU finds what is seen, and ids of " + bits + " go to the GPU: " + triangles +
           ", more than a software rasteriser draws in the time of a ray for every pixel";
  return "the GPU finds what is seen, and ids of " + bits + " go to the CPU: " + triangles;
}

std::string why_mask(const Needs& needs, const Plan& plan) {
  if (plan.mode == Mode::raster) return "no shadow mask: raster mode traces nothing";
  if (plan.mask_bits == 0 && needs.casting_lights > 0) return "no shadow mask: the plan leaves shadows out";
  if (plan.mask_bits == 0) {
    if (needs.lights == 0) return "no shadow mask: there is no light";
    return needs.idle_lights == needs.lights ? "no shadow mask: no light reaches anything"
                                             : "no shadow mask: no light casts";
  }
  return "shadow mask of " + plural(plan.mask_bits, "bit") + " a pixel" + per_sample(plan.mask_scale) + ": " +
         plural(needs.casting_lights, "light") + (needs.casting_lights == 1 ? " casts" : " cast");
}

std::string format_of(const Plan& plan) {
  switch (plan.reflection) {
    case ReflectionFormat::rgb8:
      return "24-bit sRGB, as the slides have it";
    case ReflectionFormat::rgb9e5:
      return "9 bits a colour with a shared exponent, a third less than half RGB";
    case ReflectionFormat::full:
      return "float RGB";
    default:
      return "half RGB, which keeps what is brighter than white";
  }
}

std::string why_reflection(const Needs& needs, const Plan& plan) {
  if (plan.mode == Mode::raster) return "no reflection pass: raster mode traces nothing";
  if (!needs.mirrors) return "no reflection pass: nothing mirrors or refracts";
  if (!plan.reflects()) return "no reflection pass: the plan leaves mirrors out (depth 0)";
  std::string text = "reflection pass";
  if (on_gpu(plan))
    text += ", sent as " + format_of(plan) + per_sample(plan.reflection_scale) +
            (plan.tiles ? ", where there is some" : "");
  return text + ": " + percent(needs.mirror_share) + " of the surface " +
         (needs.transmits() ? "mirrors or refracts" : "mirrors");
}

std::string why_depth(const Needs& needs, const Plan& plan) {
  const std::string bounces = plural(plan.depth, "bounce");
  if (plan.depth < needs.useful_depth) return bounces + ": as many as are asked for";
  return bounces + (needs.useful_depth == 1 ? ": no mirror sees another"
                                            : ": after them nothing is left that a pixel could show");
}

std::string why_threads(const Plan& plan) {
  return plan.threads == 0
             ? "workers on all cores: rasteriser and tracer never finish sooner by sharing them out"
             : plural(plan.threads, "worker thread") + ", as asked for";
}

std::string why_rays(const Plan& plan) {
  const std::string still = plan.reuse ? "a frame that is the last one again costs no ray, and what a light "
                                         "is known to reach costs no shadow ray"
                                       : "nothing of earlier frames is reused";
  return plan.least_light > 0.0f
             ? "no shadow ray where a light brings less than half a step of an 8-bit picture; " + still
             : "a shadow ray wherever a light may reach: the mask itself is kept; " + still;
}

}  // namespace

std::vector<std::string> explain(const Needs& needs, const Plan& plan) {
  std::vector<std::string> lines{who_draws(plan)};
  if (plan.mode == Mode::hybrid) lines.push_back(why_primary(needs, plan));
  lines.push_back(why_mask(needs, plan));
  lines.push_back(why_reflection(needs, plan));
  if (plan.reflects()) lines.push_back(why_depth(needs, plan));
  if (plan.mask_bits > 0) lines.push_back(why_rays(plan));
  if (plan.traces() || plan.mode == Mode::raytrace) lines.push_back(why_threads(plan));
  lines.emplace_back(needs.textures ? "textures are looked up: some triangle has one"
                                    : "no texture code in the shaders: nothing is textured");
  return lines;
}

}  // namespace pinocchio
