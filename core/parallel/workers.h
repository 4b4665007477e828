#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "pinocchio/conversion.h"

namespace pinocchio {

// Worker threads that live as long as this object and take tiles of one job at a time.
class Workers {
 public:
  // `threads` in all, including the caller's; 0: one per core. niceness: of the threads other than the
  // caller's (priority.h). If the system does not start all of them, fewer do the work: at most one per core.
  explicit Workers(int threads = 0, int niceness = 0);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int count() const { return as_int(threads_.size()) + 1; }

  // Calls body(i) once for every i in [0, n), on all threads, and returns when all are done. The first
  // exception of a body reaches the caller; the rest of the job is dropped. One job at a time: callers on
  // several threads take turns; a body must not start another. Threads that wake up after the last i was
  // taken are not waited for: a small job costs no more than the caller's own work.
  void for_each(std::size_t n, const std::function<void(std::size_t)>& body);

 private:
  struct Job;
  void work(Job& job);
  void wait_awake() const;
  void run_thread(int number);
  void keep(int threads);

  std::mutex turn_;  // held by the caller whose job it is
  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  Job* job_ = nullptr;
  std::uint64_t generation_ = 0;                // counts jobs, so that a thread takes each once
  std::atomic<int> busy_ = 0;                   // threads at the job; changes under the mutex
  int kept_ = std::numeric_limits<int>::max();  // threads with this number and above end
  std::vector<std::thread> threads_;
};

}  // namespace pinocchio
