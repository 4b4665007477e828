#pragma once

#include <span>

#include "gl/objects/shader_source.h"

namespace pinocchio {

// Every file of shaders/, built into the library (cmake/embed_shaders.cmake writes the definition).
[[nodiscard]] std::span<const gl::BuiltInShader> built_in_shaders();

// The files of the folder that PINOCCHIO_SHADERS names, else the built-in ones.
[[nodiscard]] gl::ShaderSource shader_source();

}  // namespace pinocchio
