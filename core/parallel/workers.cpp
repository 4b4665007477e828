#include "core/parallel/workers.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "core/parallel/priority.h"
#include "core/parallel/start_thread.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

class Workers::Pool {
 public:
  Pool(int threads, int niceness);
  ~Pool() { keep(1); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  [[nodiscard]] int count() const { return as_int(threads_.size()) + 1; }
  void for_each(std::size_t n, const std::function<void(std::size_t)>& body);

 private:
  struct Job {
    const std::function<void(std::size_t)>& body;
    std::size_t n;
    std::atomic<std::size_t> next{0};
    std::mutex error_mutex;
    std::exception_ptr error;
  };
  static void work(Job& job);
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

Workers::Workers(int threads, int niceness)
    : pool_(std::make_unique<Pool>(threads, niceness)), process_(getpid()) {}

// A forked process does not have the threads: to join them would take for ever.
Workers::~Workers() {
  if (is_forked()) (void)pool_.release();
}

bool Workers::is_forked() const {
  return getpid() != process_;
}

int Workers::count() const {
  return is_forked() ? 1 : pool_->count();
}

void Workers::for_each(std::size_t n, const std::function<void(std::size_t)>& body) {
  if (!is_forked()) return pool_->for_each(n, body);
  for (std::size_t i = 0; i < n; ++i) body(i);
}

Workers::Pool::Pool(int threads, int niceness) {
  const int cores = std::max(1u, std::thread::hardware_concurrency());
  if (threads <= 0) threads = cores;
  threads_.reserve(threads - 1);
  std::error_code why_not;
  try {
    while (count() < threads)
      threads_.emplace_back([this, niceness, number = count()] {
        if (niceness > 0) lower_priority(niceness);
        run_thread(number);
      });
  } catch (const std::system_error& error) {
    why_not = error.code();
  } catch (const std::bad_alloc&) {
    why_not = std::make_error_code(std::errc::not_enough_memory);
  }
  if (!why_not) return;
  const int started = count();
  keep(cores);
  warn_of_missing_threads(started, threads, why_not);
}

// Threads beyond the cores hold memory that the work may need: each has a stack.
void Workers::Pool::keep(int threads) {
  if (count() <= threads) return;
  {
    const std::lock_guard lock(mutex_);
    kept_ = threads;
  }
  wake_.notify_all();
  for (std::size_t i = threads - 1; i < threads_.size(); ++i) threads_[i].join();
  threads_.resize(threads - 1);
}

void Workers::Pool::for_each(std::size_t n, const std::function<void(std::size_t)>& body) {
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
    {
      const std::lock_guard lock(mutex_);
      job_ = nullptr;
    }
    wait_awake();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
  }
  if (job.error) std::rethrow_exception(job.error);
}

// Waits for the helpers, for a while without sleeping: waking up takes 50 microseconds on a virtual machine,
// longer than many a last tile.
void Workers::Pool::wait_awake() const {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::microseconds(100);
  while (busy_ != 0 && Clock::now() < end) std::this_thread::yield();  // a helper may need this core
}

void Workers::Pool::work(Job& job) {
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

void Workers::Pool::run_thread(int number) {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return number >= kept_ || (job_ && generation_ != seen); });
    if (number >= kept_) return;
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
