#include "core/parallel/start_thread.h"

#include <atomic>
#include <new>
#include <string>

#include "pinocchio/threads.h"

namespace pinocchio {
namespace {

std::atomic<ThreadWarning> thread_warning{nullptr};

}  // namespace

void set_thread_warning(ThreadWarning handler) {
  thread_warning = handler;
}

void warn_of_missing_threads(int started, int wanted, const std::error_code& why) noexcept try {
  const ThreadWarning handler = thread_warning.exchange(nullptr);
  if (!handler) return;
  const std::string count = wanted == 1 ? "a thread could not be started"
                                        : "only " + std::to_string(started) + " of " +
                                              std::to_string(wanted) + " threads could be started";
  handler((count + " (" + why.message() +
           "); the work goes on with fewer; ask for fewer threads, or raise the limit of processes "
           "('ulimit -u', a container's pids limit) or of memory ('ulimit -v')")
              .c_str());
} catch (const std::bad_alloc&) {  // no memory for the message: the work goes on without it
}

}  // namespace pinocchio
