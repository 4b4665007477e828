#include "hybrid/gpu/shaders.h"

#include <cstdlib>

namespace pinocchio {

gl::ShaderSource shader_source() {
  const char* const folder = std::getenv("PINOCCHIO_SHADERS");
  return folder && *folder ? gl::ShaderSource(std::filesystem::path(folder))
                           : gl::ShaderSource(built_in_shaders());
}

}  // namespace pinocchio
