#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pinocchio::gl {

// A shader file that was built into the program.
struct BuiltInShader {
  std::string_view name, text;
};

// Shader files by name ("composite.frag", "shared/view.glsl"): built in, or read from a folder each time.
class ShaderSource {
 public:
  // Implicit, so that a folder can stand where its shaders are meant.
  ShaderSource(std::filesystem::path folder) : folder_(std::move(folder)) {}  // NOLINT
  // `built_in` stays where it is as long as this lives.
  explicit ShaderSource(std::span<const BuiltInShader> built_in) : built_in_(built_in) {}

  // None where there is no such file.
  [[nodiscard]] std::optional<std::string> read(const std::string& name) const;
  // What messages call the file.
  [[nodiscard]] std::string path(const std::string& name) const;
  // Empty where the shaders are built in.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::span<const BuiltInShader> built_in_;
};

// A shader's text, ready for the compiler: #include "file" lines (relative to the shader folder) filled
// in, definitions put behind #version, lines numbered so that the compiler's messages can be mapped back.
struct AssembledShader {
  std::string text;
  std::vector<std::string> files;  // by the source number in the compiler's messages
};

// Throws Error naming file and line where a file cannot be read.
[[nodiscard]] AssembledShader assemble_shader(const ShaderSource& source, const std::string& file,
                                              const std::vector<std::string>& definitions);

// The compiler's message with "file:line" in place of Mesa's "0:12(3)" or NVIDIA's "0(12)".
[[nodiscard]] std::string name_files(const std::string& log, const std::vector<std::string>& files);

}  // namespace pinocchio::gl
