#include <pinocchio/threads.h>

#include "python/src/support/parts.h"

namespace {

// A RuntimeWarning. If warnings are errors, it is printed and not raised, because the work continues.
void warn(const char* line) {
  const nanobind::gil_scoped_acquire held;
  if (PyErr_WarnEx(PyExc_RuntimeWarning, line, 1) != 0) PyErr_WriteUnraisable(nullptr);
}

}  // namespace

NB_MODULE(_core, module) {
  using namespace pinocchio;
  using namespace pinocchio::python;
  module.doc() =
      "Pictures of 3D scenes as NumPy arrays: exact shadows and mirrors, with no GPU and no display.";
  module.attr("__version__") = PINOCCHIO_VERSION;
  const nb::exception<Error> error(module, "Error", PyExc_RuntimeError);
  nb::register_exception_translator(
      [](const std::exception_ptr& thrown, void* type) {
        const auto raise = [type](const std::exception& failed) {
          PyErr_SetObject(static_cast<PyObject*>(type), text(failed.what()).ptr());
        };
        try {
          std::rethrow_exception(thrown);
        } catch (const Error& wrong) {
          raise(wrong);
        } catch (const EnvironmentError& failed) {
          raise(failed);
        } catch (const std::invalid_argument& wrong) {  // an EXR has no such layer
          raise(wrong);
        }
      },
      error.ptr());
  set_thread_warning(warn);
  bind_camera(module);
  bind_material(module);
  bind_light(module);
  bind_scene(module);
  bind_result(module);
  bind_engine(module);
  bind_tracer(module);
  bind_compare(module);
}
