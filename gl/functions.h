// OpenGL's functions by their usual names: those of the context that is current on this thread.
#pragma once

#include <pinocchio_gl/functions.h>

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace pinocchio::gl {

// What a context's objects know of it. Theirs is a weak pointer: with the context its names are gone.
struct ContextData : std::enable_shared_from_this<ContextData> {
  PinocchioGladGLContext functions{};
  std::mutex mutex;                              // of the next line
  std::vector<std::function<void()>> deletions;  // of objects that ended while it was not current
};

// Null where none of ours is current on this thread.
extern constinit thread_local ContextData* current;

// Deletes an object of that context: now where it is current on this thread, else when it next is.
void delete_in(const std::weak_ptr<ContextData>& context, std::function<void()> deletion) noexcept;

}  // namespace pinocchio::gl
