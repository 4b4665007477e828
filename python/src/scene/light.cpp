#include <pinocchio/light.h>

#include <nanobind/stl/string_view.h>
#include <algorithm>
#include <cmath>

#include "python/src/scene/pickle.h"
#include "python/src/support/parts.h"

namespace pinocchio::python {
namespace {

constexpr double kLargest = std::numeric_limits<float>::max();

glm::vec3 unit(const Three& argument) {
  const glm::vec3 direction = argument.read("direction");
  if (glm::length(direction) == 0.0f) throw Error("a light's direction must not be zero");
  return glm::normalize(direction);
}

Light::Falloff falloff_of(const std::string& falloff) {
  if (falloff != "none" && falloff != "inverse_square")
    throw Error("falloff is '" + falloff + "'; it is 'none' or 'inverse_square'");
  return falloff == "none" ? Light::Falloff::none : Light::Falloff::inverse_square;
}

float checked_range(float range) {
  if (!(range > 0.0f))
    throw Error("range is " + shown(range) + "; it is above 0, and inf for light without end");
  return range;
}

Light light_of(const std::optional<Three>& position, const std::optional<Three>& direction,
               const Three& color, float intensity, const std::string& falloff, float range, float inner_cone,
               float outer_cone, bool casts_shadow, const std::string& name, float radius, float angle) {
  if (!position && !direction)
    throw Error("a light needs a position (a point), a direction (a sun) or both (a spot)");
  Light light;
  light.name = name;
  // The first kind that has what is given: no rectangle.
  const auto* const kind = std::ranges::find_if(kLightKinds, [&](const LightKind& row) {
    return row.has_position == position.has_value() && row.has_direction == direction.has_value();
  });
  light.kind = kind->kind;
  if (position) light.position = position->read("position");
  if (direction) light.direction = unit(*direction);
  light.color = color.read_color("color");
  light.intensity = number_within(intensity, "intensity", 0.0, kLargest);
  light.falloff = falloff_of(falloff);
  light.range = checked_range(range);
  if (kind->has_cone) {
    (void)number_within(outer_cone, "outer_cone", 0.0, 90.0);
    (void)number_within(inner_cone, "inner_cone", 0.0, outer_cone);
    light.cos_inner = std::cos(glm::radians(inner_cone));
    light.cos_outer = std::cos(glm::radians(outer_cone));
  }
  light.casts_shadow = casts_shadow;
  light.radius = number_within(radius, "radius", 0.0, kLargest);
  light.angle_deg = number_within(angle, "angle", 0.0, 180.0);
  return light;
}

}  // namespace

void bind_light(nb::module_& module) {
  nb::class_<Light> bound(module, "Light", "A point light, a sun or a spot light.");
  bound
      .def(
          "__init__",
          [](Light* self, const std::optional<Three>& position, const std::optional<Three>& direction,
             const Three& color, float intensity, const std::string& falloff, float range, float inner_cone,
             float outer_cone, bool casts_shadow, const std::string& name, float radius, float angle) {
            new (self) Light(light_of(position, direction, color, intensity, falloff, range, inner_cone,
                                      outer_cone, casts_shadow, name, radius, angle));
          },
          "position"_a = nb::none(), "direction"_a = nb::none(), "color"_a = glm::vec3(1.0f),
          "intensity"_a = 1.0f, "falloff"_a = "none", "range"_a = std::numeric_limits<float>::infinity(),
          "inner_cone"_a = 0.0f, "outer_cone"_a = 45.0f, "casts_shadow"_a = true, "name"_a = "",
          "radius"_a = 0.0f, "angle"_a = 0.0f,
          "A light with a position is a point light, one with a direction a sun, one with both a spot "
          "light.\n"
          "position, direction: three numbers each; the light travels along the direction.\n"
          "inner_cone, outer_cone: the spot light's cones, in degrees from its direction.\n"
          "falloff: 'none' (the same strength at any distance) or 'inverse_square'.\n"
          "range: no light reaches beyond it, in scene units.\n"
          "casts_shadow: each casting light is a bit of Result.mask.\n"
          "radius: of the shining sphere, in scene units. angle: the diameter of a sun's disc, in degrees. "
          "With either,\n"
          "several samples (spp) give soft shadows.\n"
          "Raises Error if there is neither position nor direction, falloff is another word, or a number is "
          "not in "
          "its range.")
      .def_prop_ro(
          "kind", [](const Light& light) { return kind_of(light).name; },
          "'point', 'directional', 'spot' or 'rectangle'.")
      .def_rw("name", &Light::name)
      .def_rw("casts_shadow", &Light::casts_shadow)
      .def_prop_rw(
          "direction", [](const Light& l) { return l.direction; },
          [](Light& l, const Three& d) { l.direction = unit(d); }, "Unit; the light travels along it.")
      .def_prop_rw(
          "falloff",
          [](const Light& l) { return l.falloff == Light::Falloff::none ? "none" : "inverse_square"; },
          [](Light& l, const std::string& falloff) { l.falloff = falloff_of(falloff); })
      .def_prop_rw(
          "range", [](const Light& l) { return l.range; },
          [](Light& l, float range) { l.range = checked_range(range); },
          "In scene units; no light reaches beyond.")
      .def_prop_ro(
          "inner_cone", [](const Light& l) { return glm::degrees(std::acos(l.cos_inner)); },
          "Of a spot light, in degrees from its direction.")
      .def_prop_ro(
          "outer_cone", [](const Light& l) { return glm::degrees(std::acos(l.cos_outer)); },
          "Of a spot light, in degrees from its direction.")
      .def("__repr__",
           [](const Light& l) {
             const LightKind& kind = kind_of(l);
             return "<Light " + (l.name.empty() ? "" : shown(l.name) + ", ") + std::string(kind.name) +
                    (kind.has_position ? ", position=" + shown(l.position) : "") +
                    (kind.has_direction ? ", direction=" + shown(l.direction) : "") +
                    ", intensity=" + shown(l.intensity) + ">";
           })
      .def("__copy__", [](const Light& light) { return light; })
      .def(
          "__deepcopy__", [](const Light& light, nb::handle) { return light; }, "memo"_a)
      .def("__getstate__", [](const Light& light) { return pickled(light); })
      .def("__setstate__", [](Light& self, const nb::bytes& state) {
        Light read;
        unpickle(state, read);
        new (&self) Light(std::move(read));
      });
  def_number(bound, "intensity", &Light::intensity, 0.0, kLargest, "The factor of `color`.");
  def_number(bound, "radius", &Light::radius, 0.0, kLargest, "Of the shining sphere, in scene units.");
  def_number(bound, "angle", &Light::angle_deg, 0.0, 180.0, "The diameter of a sun's disc, in degrees.");
  def_three(
      bound, "position", [](Light& l) -> glm::vec3& { return l.position; }, "In world space, scene units.");
  def_three(
      bound, "color", [](Light& l) -> glm::vec3& { return l.color; }, "Linear RGB.", &Three::read_color);
}

}  // namespace pinocchio::python
