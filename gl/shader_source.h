#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pinocchio::gl {

// A shader's text, ready for the compiler: #include "file" lines (relative to the shader folder) filled
// in, definitions put behind #version, lines numbered so that the compiler's messages can be mapped back.
struct ShaderSource {
  std::string text;
  std::vector<std::string> files;  // by the source number in the compiler's messages
};

// Throws Error naming file and line where a file cannot be read.
[[nodiscard]] ShaderSource load_shader_source(const std::filesystem::path& folder, const std::string& file,
                                              const std::vector<std::string>& definitions);

// The compiler's message with "file:line" in place of Mesa's "0:12(3)" or NVIDIA's "0(12)".
[[nodiscard]] std::string name_files(const std::string& log, const std::vector<std::string>& files);

}  // namespace pinocchio::gl
