#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "gl/program.h"
#include "hybrid/shaders.h"
#include "pinocchio/error.h"

namespace pinocchio {

// The passes' programs, compiled when first asked for: a scene pays for what it has.
class Programs {
 public:
  using Definitions = std::vector<std::string>;

  explicit Programs(gl::ShaderSource shaders = shader_source()) : shaders_(std::move(shaders)) {}

  // Stays where it is as long as this lives; after reload() it is the new one. Throws gl::Error with file,
  // line and the compiler's message.
  [[nodiscard]] const gl::Program& get(const std::string& vertex_file, const std::string& fragment_file,
                                       const Definitions& definitions = {});

  // All of them are compiled again when they are next asked for.
  void forget() {
    programs_.clear();
    ++generation_;
  }
  // Compiles every program that was asked for so far anew, from the files as a folder has them now. Where one
  // fails, all stay as they were and the error says why: file, line, the compiler's message.
  [[nodiscard]] Expected<void> reload();

  // How often reload() has succeeded: what was drawn before is not what would be drawn now.
  [[nodiscard]] int generation() const { return generation_; }

  // That the shaders are read from; empty where they are built in.
  [[nodiscard]] const std::filesystem::path& folder() const { return shaders_.folder(); }

 private:
  using Key = std::tuple<std::string, std::string, Definitions>;

  [[nodiscard]] gl::Program compile(const Key& key) const;

  gl::ShaderSource shaders_;
  std::map<Key, gl::Program> programs_;
  int generation_ = 0;
};

}  // namespace pinocchio
