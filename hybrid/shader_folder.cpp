#include "hybrid/shader_folder.h"

#include <cstdlib>
#include <system_error>

namespace pinocchio {

std::filesystem::path shader_folder() {
  if (const char* named = std::getenv("PINOCCHIO_SHADERS")) return named;
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::filesystem::path installed = program.parent_path().parent_path() / "share/pinocchio/shaders";
  if (!unknown && std::filesystem::is_directory(installed, unknown)) return installed;
  return PINOCCHIO_SHADER_SOURCE_DIR;
}

}  // namespace pinocchio
