#pragma once

#include <glm/glm.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "gl/objects/shader_source.h"
#include "gl/objects/texture.h"

namespace pinocchio::gl {

struct DeleteProgram {
  void operator()(GLuint name) const { glDeleteProgram(name); }
};

// A vertex and a fragment shader, compiled and linked.
class Program {
 public:
  Program() = default;
  // Each definition ("NAME" or "NAME VALUE") is #defined in both files. Throws Error with file, line and the
  // compiler's message.
  Program(const ShaderSource& source, const std::string& vertex_file, const std::string& fragment_file,
          const std::vector<std::string>& definitions = {});

  void use() const { glUseProgram(handle_.name()); }

  // Uniforms of the program in use. Names that the compiler dropped are ignored.
  void set(const char* name, int value) const { glUniform1i(location(name), value); }
  void set(const char* name, unsigned value) const { glUniform1ui(location(name), value); }
  void set(const char* name, float value) const { glUniform1f(location(name), value); }
  void set(const char* name, const glm::vec2& v) const { glUniform2f(location(name), v.x, v.y); }
  void set(const char* name, const glm::vec3& v) const { glUniform3f(location(name), v.x, v.y, v.z); }
  void set(const char* name, const glm::mat3& m) const {
    glUniformMatrix3fv(location(name), 1, GL_FALSE, &m[0][0]);
  }
  // Binds the texture to the unit, and the sampler to that unit.
  void set(const char* sampler, int unit, const Texture& texture) const;
  void set(const char* sampler, int unit, const TextureBuffer& buffer) const;

 private:
  [[nodiscard]] GLint location(const char* name) const;

  Handle<DeleteProgram> handle_;
  mutable std::unordered_map<std::string, GLint> locations_;
};

}  // namespace pinocchio::gl
