#pragma once

#include <dlfcn.h>

#include <array>

namespace pinocchio::gl {

inline constexpr std::array kOsmesaLibraries{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};

// Whether the library has a function of that name.
template <class Function>
[[nodiscard]] bool find_function(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

}  // namespace pinocchio::gl
