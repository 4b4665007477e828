#include "hybrid/explain.h"

#include <cmath>

namespace pinocchio {
namespace {

std::string plural(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string why_ids(const Needs& needs, const Plan& plan) {
  if (!plan.traces()) return "ids stay on the GPU: nothing is left for the CPU to trace";
  return "ids of " + std::to_string(plan.id_bits) +
         " bits go to the CPU: " + std::to_string(needs.triangles) + " triangles to name";
}

std::string why_mask(const Needs& needs, const Plan& plan) {
  if (plan.mode == Mode::raster) return "no shadow mask: raster mode traces nothing";
  if (plan.mask_bits == 0)
    return needs.lights == 0 ? "no shadow mask: there is no light" : "no shadow mask: no light casts";
  return "shadow mask of " + plural(plan.mask_bits, "bit") +
         " a pixel: " + plural(needs.casting_lights, "light") +
         (needs.casting_lights == 1 ? " casts" : " cast");
}

std::string why_reflection(const Needs& needs, const Plan& plan) {
  if (plan.mode == Mode::raster) return "no reflection pass: raster mode traces nothing";
  if (!needs.mirrors) return "no reflection pass: nothing mirrors or refracts";
  if (!plan.reflects()) return "no reflection pass: --depth 0";
  const int percent = static_cast<int>(std::ceil(100.0 * needs.mirror_share));
  return "reflection pass to depth " + std::to_string(plan.depth) + ", sent as " +
         (plan.reflection == ReflectionFormat::half ? "half RGB, which keeps what is brighter than white"
                                                    : "24-bit sRGB, as the slides have it") +
         ": " + std::to_string(percent) + " % of the surface " +
         (needs.transmits ? "mirrors or refracts" : "mirrors");
}

}  // namespace

std::vector<std::string> explain(const Needs& needs, const Plan& plan) {
  std::vector<std::string> lines;
  switch (plan.mode) {
    case Mode::hybrid:
      lines.emplace_back(plan.design == 1
                             ? "the GPU finds what is seen and puts the picture together (design 1)"
                             : "the GPU finds what is seen, the CPU puts the picture together (design 2)");
      break;
    case Mode::raytrace:
      lines.emplace_back("the CPU draws alone; no OpenGL is opened");
      break;
    case Mode::raster:
      lines.emplace_back("the GPU draws alone");
      break;
  }
  if (plan.mode == Mode::hybrid) lines.push_back(why_ids(needs, plan));
  lines.push_back(why_mask(needs, plan));
  lines.push_back(why_reflection(needs, plan));
  lines.emplace_back(needs.textures ? "textures are looked up: some triangle has one"
                                    : "no texture code in the shaders: nothing is textured");
  return lines;
}

}  // namespace pinocchio
