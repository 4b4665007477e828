#include "gl/objects/fence.h"

#include "gl/context/context.h"
#include "gl/context/error.h"

namespace pinocchio::gl {

Fence Fence::insert() {
  Fence fence;
  const GLsync sync = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (!sync) throw Error("the GPU cannot be waited for: glFenceSync failed");
  fence.sync_ = Handle<DeleteSync, GLsync>(sync);
  glFlush();  // without it the GPU might not begin before a wait
  return fence;
}

void Fence::wait() const {
  if (!sync_) return;
  const GLsync sync = sync_.name();
  constexpr GLuint64 kOneSecond_ns = 1'000'000'000;
  for (;;) {
    const GLenum status = glClientWaitSync(sync, 0, kOneSecond_ns);
    if (status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED) return;
    if (context_lost())
      throw ContextLostError("waiting for the GPU failed: its OpenGL context is lost; start again");
    if (status == GL_WAIT_FAILED) throw Error("waiting for the GPU failed: glClientWaitSync");
  }
}

}  // namespace pinocchio::gl
