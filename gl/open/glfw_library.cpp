#include "gl/open/glfw_library.h"

#include <dlfcn.h>

#include <string>

#include "gl/context/error.h"
#include "gl/context/library.h"

namespace pinocchio::gl {

const GlfwFunctions& glfw() {
  static const GlfwFunctions loaded = [] {
    void* const library = dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL);
    if (!library) throw Error(std::string(dlerror()) + "; install GLFW 3 (Debian: libglfw3)");
    GlfwFunctions functions;
    const auto resolve = [library](auto& function, const char* name) {
      if (!find_function(library, name, function)) throw Error(std::string("libglfw has no ") + name);
    };
#define PINOCCHIO_RESOLVE(name) resolve(functions.name, "glfw" #name);
    PINOCCHIO_GLFW_FUNCTIONS(PINOCCHIO_RESOLVE)
#undef PINOCCHIO_RESOLVE
    return functions;
  }();
  return loaded;
}

}  // namespace pinocchio::gl
