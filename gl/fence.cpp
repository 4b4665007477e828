#include "gl/fence.h"

#include "gl/context.h"
#include "gl/error.h"

namespace pinocchio::gl {

Fence Fence::insert() {
  Fence fence;
  fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();  // or the GPU might not begin before somebody waits
  return fence;
}

void Fence::wait() const {
  if (!sync_) return;
  constexpr GLuint64 kOneSecond_ns = 1'000'000'000;
  for (;;) {
    const GLenum status = glClientWaitSync(sync_, 0, kOneSecond_ns);
    if (status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED) return;
    if (status == GL_WAIT_FAILED || context_lost())
      throw ContextLostError("waiting for the GPU failed: its OpenGL context is lost; start again");
  }
}

}  // namespace pinocchio::gl
