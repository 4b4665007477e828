#pragma once

#include <span>

#include "gl/shader_source.h"

namespace pinocchio {

// Every file of shaders/, built into the library (cmake/embed_shaders.cmake writes the definition).
[[nodiscard]] std::span<const gl::BuiltInShader> built_in_shaders();

// These; while one works on them, the files of the folder that PINOCCHIO_SHADERS names.
[[nodiscard]] gl::ShaderSource shader_source();

}  // namespace pinocchio
