#include "gl/error_flags.h"

#include "gl/handle.h"

namespace pinocchio::gl {
namespace {

constexpr int kMostErrors = 16;  // a driver keeps one a kind; where the context is lost, there is no end

}  // namespace

void forget_errors() {
  for (int i = 0; i < kMostErrors && glGetError() != GL_NO_ERROR; ++i) {
  }
}

bool ran_out_of_memory() {
  for (int i = 0; i < kMostErrors; ++i) {
    const GLenum error = glGetError();
    if (error == GL_OUT_OF_MEMORY) return true;
    if (error == GL_NO_ERROR) break;
  }
  return false;
}

}  // namespace pinocchio::gl
