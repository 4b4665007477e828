#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace pinocchio {

// Worker threads that live as long as this object and take tiles of one job at a time. A forked process has
// no workers: there the caller's thread does all the work.
class Workers {
 public:
  // `threads` in all, including the caller's; 0: one per core. niceness: of the threads other than the
  // caller's (priority.h). If the system does not start all of them, fewer do the work: at most one per core.
  explicit Workers(int threads = 0, int niceness = 0);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int count() const;

  // Calls body(i) once for every i in [0, n), on all threads, and returns when all are done. The first
  // exception of a body reaches the caller; the rest of the job is dropped. One job at a time: callers on
  // several threads take turns; a body must not start another. Threads that wake up after the last i was
  // taken are not waited for: a small job costs no more than the caller's own work.
  void for_each(std::size_t n, const std::function<void(std::size_t)>& body);

 private:
  class Pool;
  [[nodiscard]] bool is_forked() const;

  std::unique_ptr<Pool> pool_;
  int process_;  // the process that started the threads
};

}  // namespace pinocchio
