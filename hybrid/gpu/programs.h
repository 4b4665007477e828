#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "gl/objects/program.h"
#include "hybrid/gpu/shaders.h"
#include "pinocchio/error.h"

namespace pinocchio {

// The passes' programs, compiled at their first use.
class Programs {
 public:
  using Definitions = std::vector<std::string>;

  explicit Programs(gl::ShaderSource shaders = shader_source()) : shaders_(std::move(shaders)) {}

  // The reference stays valid as long as this object, and refers to the new program after reload(). Throws
  // gl::Error with file, line and the compiler's message.
  [[nodiscard]] const gl::Program& get(const std::string& vertex_file, const std::string& fragment_file,
                                       const Definitions& definitions = {});

  // Drops all programs; they are compiled again at their next use.
  void forget() {
    programs_.clear();
    ++generation_;
  }
  // Recompiles every program that was used so far, from the folder's files. Where one fails, all stay as they
  // were, and the error has file, line and the compiler's message.
  [[nodiscard]] Expected<void> reload();

  // Counts reloads: pictures of an earlier generation may differ.
  [[nodiscard]] int generation() const { return generation_; }

  // Folder the shaders are read from. Empty: the built-in ones.
  [[nodiscard]] const std::filesystem::path& folder() const { return shaders_.folder(); }

 private:
  using Key = std::tuple<std::string, std::string, Definitions>;

  [[nodiscard]] gl::Program compile(const Key& key) const;

  gl::ShaderSource shaders_;
  std::map<Key, gl::Program> programs_;
  int generation_ = 0;
};

}  // namespace pinocchio
