// Threads that the system may refuse to start: limits of processes (a container's, too) and of memory.
#pragma once

#include <future>
#include <memory>
#include <system_error>
#include <type_traits>
#include <utility>

#include "core/parallel/priority.h"

namespace pinocchio {

// Calls the handler of set_thread_warning(), the first time only.
void warn_of_missing_threads(int started, int wanted, const std::error_code& why) noexcept;

// A std::thread or std::jthread that runs `body`; not joinable if the system starts none.
template <class Thread, class Body>
[[nodiscard]] Thread start_thread(Body body) {
  try {
    return Thread(std::move(body));
  } catch (const std::system_error& error) {
    warn_of_missing_threads(0, 1, error.code());
    return {};
  }
}

// Runs `work` on a thread of its own with this niceness. If the system starts none, the work is done when
// this returns. The future's destructor waits for the work.
template <class Work>
[[nodiscard]] std::future<std::invoke_result_t<Work&>> run_aside(int niceness, Work work) {
  const auto kept = std::make_shared<Work>(std::move(work));
  try {
    return std::async(std::launch::async, [kept, niceness] {
      if (niceness > 0) lower_priority(niceness);
      return (*kept)();
    });
  } catch (const std::system_error& error) {
    warn_of_missing_threads(0, 1, error.code());
  }
  std::packaged_task<std::invoke_result_t<Work&>()> task([&kept] { return (*kept)(); });
  task();
  return task.get_future();
}

}  // namespace pinocchio
