#include "core/parallel/workers.h"

#include <algorithm>
#include <atomic>

#include "core/parallel/priority.h"

namespace pinocchio {

struct Workers::Job {
  const std::function<void(std::size_t)>& body;
  std::size_t n;
  std::atomic<std::size_t> next{0};
  std::mutex error_mutex;
  std::exception_ptr error;
};

Workers::Workers(int threads, int niceness) {
  if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  threads_.reserve(static_cast<std::size_t>(threads) - 1);
  for (int i = 1; i < threads; ++i)
    threads_.emplace_back([this, niceness] {
      if (niceness > 0) give_way(niceness);
      run_thread();
    });
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::for_each(std::size_t n, const std::function<void(std::size_t)>& body) {
  const std::lock_guard turn(turn_);
  Job job{body, n, {}, {}, {}};
  const std::size_t helpers = n > 1 ? std::min(n - 1, threads_.size()) : 0;
  if (helpers > 0) {
    const std::lock_guard lock(mutex_);
    job_ = &job;
    ++generation_;
  }
  if (helpers == threads_.size()) {
    wake_.notify_all();
  } else {
    for (std::size_t i = 0; i < helpers; ++i) wake_.notify_one();
  }
  work(job);
  if (helpers > 0) {
    std::unique_lock lock(mutex_);
    job_ = nullptr;
    done_.wait(lock, [this] { return busy_ == 0; });
  }
  if (job.error) std::rethrow_exception(job.error);
}

void Workers::work(Job& job) {
  for (std::size_t i; (i = job.next.fetch_add(1, std::memory_order_relaxed)) < job.n;) {
    try {
      job.body(i);
    } catch (...) {
      const std::lock_guard lock(job.error_mutex);
      if (!job.error) job.error = std::current_exception();
      job.next = job.n;
    }
  }
}

void Workers::run_thread() {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return stop_ || (job_ && generation_ != seen); });
    if (stop_) return;
    seen = generation_;
    Job& job = *job_;
    ++busy_;
    lock.unlock();
    work(job);
    lock.lock();
    if (--busy_ == 0) done_.notify_one();
  }
}

}  // namespace pinocchio
