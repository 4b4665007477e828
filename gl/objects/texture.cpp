#include "gl/objects/texture.h"

#include <string>

#include "gl/context/context.h"
#include "gl/context/error.h"

namespace pinocchio::gl {
namespace {

TextureHandle make_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  return TextureHandle(name);
}

GLint limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace

Texture::Texture(glm::ivec2 size, const PixelFormat& format)
    : handle_(make_texture()), size_(size), format_(format) {
  const GLint most = limit(GL_MAX_TEXTURE_SIZE);
  if (size.x > most || size.y > most)
    throw Error("a picture of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                " is beyond this OpenGL's limit of " + std::to_string(most) +
                " pixels a side; draw it in --crop parts");
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);  // a bound buffer would fill the texture
  glBindTexture(GL_TEXTURE_2D, handle_.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, format.internal, size.x, size.y, 0, format.format, format.type, nullptr);
  throw_errors("the GPU has no room for a picture of " + std::to_string(size.x) + "x" +
               std::to_string(size.y));
}

TextureBuffer::TextureBuffer(std::span<const std::byte> data, GLenum internal_format,
                             std::size_t bytes_per_texel)
    : buffer_(data), handle_(make_texture()) {
  const std::size_t texels = data.size() / bytes_per_texel;
  if (const GLint most = limit(GL_MAX_TEXTURE_BUFFER_SIZE); texels > std::size_t(most))
    throw Error("the scene is too large for this OpenGL: a buffer of " + std::to_string(texels) +
                " texels, the limit is " + std::to_string(most) + "; --mode raytrace has no such limit");
  glBindTexture(GL_TEXTURE_BUFFER, handle_.name());
  glTexBuffer(GL_TEXTURE_BUFFER, internal_format, buffer_.name());
  throw_errors();
}

}  // namespace pinocchio::gl
