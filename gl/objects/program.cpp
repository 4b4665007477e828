#include "gl/objects/program.h"

#include <algorithm>
#include <cassert>

#include "gl/context/context.h"
#include "gl/context/error.h"
#include "gl/context/state.h"

namespace pinocchio::gl {
namespace {

struct DeleteShader {
  void operator()(GLuint name) const { glDeleteShader(name); }
};
using Shader = Handle<DeleteShader>;

// The first line of a compiler's log describes the first mistake.
std::string first_line(const std::string& log) {
  return log.substr(0, log.find('\n'));
}

template <class GetLog>
std::string read_log(GLint length, GetLog get) {
  std::string log(std::max(length, 1), '\0');
  get(log.size(), log.data());
  return log.substr(0, log.find('\0'));
}

Shader compile(GLenum stage, const ShaderSource& source, const std::string& file,
               const std::vector<std::string>& definitions) {
  const AssembledShader assembled = assemble_shader(source, file, definitions);
  Shader shader(glCreateShader(stage));
  const char* text = assembled.text.c_str();
  glShaderSource(shader.name(), 1, &text, nullptr);
  glCompileShader(shader.name());
  GLint compiled = 0, length = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  const std::string log =
      read_log(length, [&](GLsizei n, char* to) { glGetShaderInfoLog(shader.name(), n, nullptr, to); });
  throw_errors();
  throw Error("shader does not compile: " + first_line(name_files(log, assembled.files)));
}

// No sampler object is bound: textures are read by their own parameters.
void select(int unit) {
  assert(unit < kTextureUnits);
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindSampler(unit, 0);
}

}  // namespace

Program::Program(const ShaderSource& source, const std::string& vertex_file, const std::string& fragment_file,
                 const std::vector<std::string>& definitions) {
  const Shader vertex = compile(GL_VERTEX_SHADER, source, vertex_file, definitions);
  const Shader fragment = compile(GL_FRAGMENT_SHADER, source, fragment_file, definitions);
  handle_ = Handle<DeleteProgram>(glCreateProgram());
  const GLuint name = handle_.name();
  glAttachShader(name, vertex.name());
  glAttachShader(name, fragment.name());
  glLinkProgram(name);
  GLint linked = 0, length = 0;
  glGetProgramiv(name, GL_LINK_STATUS, &linked);
  throw_errors();
  if (linked) return;
  glGetProgramiv(name, GL_INFO_LOG_LENGTH, &length);
  const std::string log =
      read_log(length, [&](GLsizei n, char* to) { glGetProgramInfoLog(name, n, nullptr, to); });
  throw Error(source.path(vertex_file) + " and " + fragment_file + " do not link: " + first_line(log));
}

void Program::set(const char* sampler, int unit, const Texture& texture) const {
  select(unit);
  glBindTexture(GL_TEXTURE_2D, texture.name());
  set(sampler, unit);
}

void Program::set(const char* sampler, int unit, const TextureBuffer& buffer) const {
  select(unit);
  glBindTexture(GL_TEXTURE_BUFFER, buffer.name());
  set(sampler, unit);
}

GLint Program::location(const char* name) const {
  const auto [at, is_new] = locations_.try_emplace(name, -1);
  if (is_new) at->second = glGetUniformLocation(handle_.name(), name);
  return at->second;
}

}  // namespace pinocchio::gl
