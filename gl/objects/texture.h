#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "gl/context/handle.h"
#include "gl/objects/buffer.h"

namespace pinocchio::gl {

// How a pixel is stored, and how it is transferred (in tightly packed rows).
struct PixelFormat {
  GLenum internal;
  GLenum format;
  GLenum type;
  std::size_t bytes;  // per transferred pixel

  friend bool operator==(const PixelFormat&, const PixelFormat&) = default;
};
inline constexpr PixelFormat kR8Ui{GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1};
inline constexpr PixelFormat kR16Ui{GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT, 2};
inline constexpr PixelFormat kR32Ui{GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4};
inline constexpr PixelFormat kRg32Ui{GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8};
inline constexpr PixelFormat kId24{GL_RGBA8UI, GL_RGB_INTEGER, GL_UNSIGNED_BYTE,
                                   3};  // the fourth byte is not transferred
inline constexpr PixelFormat kRgba32Ui{GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16};
inline constexpr PixelFormat kRgb8{GL_RGBA8, GL_RGB, GL_UNSIGNED_BYTE, 3};
inline constexpr PixelFormat kSrgb8{GL_SRGB8_ALPHA8, GL_RGB, GL_UNSIGNED_BYTE, 3};
inline constexpr PixelFormat kR8{GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1};
inline constexpr PixelFormat kRgb9E5{GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, 4};
inline constexpr PixelFormat kR32F{GL_R32F, GL_RED, GL_FLOAT, 4};
inline constexpr PixelFormat kR16F{GL_R16F, GL_RED, GL_HALF_FLOAT, 2};
inline constexpr PixelFormat kRg16F{GL_RG16F, GL_RG, GL_HALF_FLOAT, 4};
inline constexpr PixelFormat kRgb16F{GL_RGB16F, GL_RGB, GL_HALF_FLOAT, 6};
inline constexpr PixelFormat kRgba16F{GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8};
inline constexpr PixelFormat kRgb32F{GL_RGB32F, GL_RGB, GL_FLOAT, 12};
inline constexpr PixelFormat kRgba32F{GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};
inline constexpr PixelFormat kDepth32F{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4};

struct DeleteTexture {
  void operator()(GLuint name) const { glDeleteTextures(1, &name); }
};
using TextureHandle = Handle<DeleteTexture>;

// A 2D texture without mipmaps, read by texelFetch. Throws Error where the size is beyond the GPU's limit or
// memory.
class Texture {
 public:
  Texture() = default;
  Texture(glm::ivec2 size, const PixelFormat& format);

  [[nodiscard]] GLuint name() const { return handle_.name(); }
  [[nodiscard]] glm::ivec2 size() const { return size_; }
  [[nodiscard]] const PixelFormat& format() const { return format_; }
  [[nodiscard]] std::size_t bytes() const {
    return std::size_t(size_.x) * std::size_t(size_.y) * format_.bytes;
  }

 private:
  TextureHandle handle_;
  glm::ivec2 size_{0, 0};
  PixelFormat format_ = kR8Ui;
};

// A buffer that shaders read as texels. Throws Error where it has more texels than the GPU can address.
class TextureBuffer {
 public:
  TextureBuffer() = default;
  TextureBuffer(std::span<const std::byte> data, GLenum internal_format, std::size_t bytes_per_texel);
  template <class T>
  TextureBuffer(std::span<const T> data, GLenum internal_format, std::size_t bytes_per_texel)
      : TextureBuffer(std::as_bytes(data), internal_format, bytes_per_texel) {}

  [[nodiscard]] GLuint name() const { return handle_.name(); }
  // Replaces the elements from `first` on.
  template <class T>
  void write(std::size_t first, std::span<const T> data) {
    buffer_.write(first, data);
  }

 private:
  Buffer buffer_;
  TextureHandle handle_;
};

}  // namespace pinocchio::gl
