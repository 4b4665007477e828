#include "python/src/scene/environment.h"

#include <pinocchio/environment.h>

#include <nanobind/stl/filesystem.h>
#include <algorithm>
#include <cmath>

#include "pinocchio/conversion.h"
#include "python/src/support/interrupt.h"

namespace pinocchio::python {

void warn_of(const Warnings& warnings) {
  for (const Warning& warning : warnings)
    if (PyErr_WarnFormat(PyExc_UserWarning, 1, "%U", text(warning.message()).ptr()) != 0)
      throw nb::python_error();
}

void set_environment(PyScene& self, nb::handle value) {
  if (value.is_none()) {
    self.scene.environment = nullptr;
    return;
  }
  if (std::filesystem::path path; nb::isinstance<nb::str>(value) || nb::hasattr(value, "__fspath__")) {
    path = nb::cast<std::filesystem::path>(value);
    Warnings warnings;
    self.scene.environment = value_or_throw(without_gil(
        [&](Progress* progress) { return load_environment(path, progress, kUsualLoadLimit, &warnings); }));
    warn_of(warnings);
    return;
  }
  const auto array = Pixels{nb::borrow(value)}.read("environment");
  if (array.size() == 0) throw Error("environment is empty; it is an array (height, width, 3) of light");
  if (!std::all_of(array.data(), array.data() + array.size(),
                   [](float v) { return v >= 0.0f && std::isfinite(v); }))
    throw Error("environment holds light that is negative or not finite");
  Image<glm::vec3> light({array.shape(1), array.shape(0)});
  std::copy_n(array.data(), array.size(), &light.pixels().data()->x);
  self.scene.environment = std::make_shared<const Environment>(std::move(light));
}

nb::object environment_of(const PyScene& self) {
  if (!self.scene.environment) return nb::none();
  auto* const kept = new std::shared_ptr<const Environment>(self.scene.environment);
  const nb::capsule owner(
      kept, [](void* p) noexcept { delete static_cast<std::shared_ptr<const Environment>*>(p); });
  const Image<glm::vec3>& light = (*kept)->radiance();
  return nb::cast(view_of<const float>(&light.pixels().data()->x,
                                       {as_size(light.height()), as_size(light.width()), 3}, owner));
}

}  // namespace pinocchio::python
