// OpenGL's functions by their usual names: those of the context that is current on this thread.
#pragma once

#include <pinocchio_gl/functions.h>

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace pinocchio::gl {

// A context as its objects see it. They hold weak pointers: the names end with the context.
struct ContextData : std::enable_shared_from_this<ContextData> {
  PinocchioGladGLContext functions{};
  std::mutex mutex;                              // guards `deletions`
  std::vector<std::function<void()>> deletions;  // objects that ended while the context was not current
};

// Null: no context of ours is current on this thread.
extern constinit thread_local ContextData* current;

// Deletes an object of that context: at once if it is current on this thread, else when it is next current.
void delete_in(const std::weak_ptr<ContextData>& context, std::function<void()> deletion) noexcept;

}  // namespace pinocchio::gl
