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

// Shader files by name ("composite.frag", "shared/view.glsl"): built in, or read from a folder at each use.
class ShaderSource {
 public:
  // Implicit, so that a folder can be passed where its shaders are meant.
  ShaderSource(std::filesystem::path folder) : folder_(std::move(folder)) {}  // NOLINT
  // `built_in` outlives this object.
  explicit ShaderSource(std::span<const BuiltInShader> built_in) : built_in_(built_in) {}

  // None: there is no such file.
  [[nodiscard]] std::optional<std::string> read(const std::string& name) const;
  // The file's path in messages.
  [[nodiscard]] std::string path(const std::string& name) const;
  // Empty: the shaders are built in.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::span<const BuiltInShader> built_in_;
};

// A shader's text for the compiler: #include "file" lines (relative to the shader folder) are replaced by the
// files, definitions follow #version, and #line tells the compiler the source's lines.
struct AssembledShader {
  std::string text;
  std::vector<std::string> files;  // by the source number in the compiler's messages
};

// Throws Error with the file's name where a file cannot be read.
[[nodiscard]] AssembledShader assemble_shader(const ShaderSource& source, const std::string& file,
                                              const std::vector<std::string>& definitions);

// The compiler's message with "file:line" in place of Mesa's "0:12(3)" or NVIDIA's "0(12)".
[[nodiscard]] std::string name_files(const std::string& log, const std::vector<std::string>& files);

}  // namespace pinocchio::gl
