// Progress and cancellation of long work. Every function that takes long has a Progress*, as its last
// argument or in its options. Null, the default, costs nothing:
//
//   Progress progress;                              // must outlive the work
//   std::thread watcher([&] { show(progress.phase(), progress.fraction()); });
//   load_scene(file, &warnings, &progress);         // throws Cancelled soon after progress.cancel()
#pragma once

#include <algorithm>
#include <atomic>
#include <stdexcept>

namespace pinocchio {

// Thrown on the calling thread by work whose Progress was cancelled. No file is half written, and every
// object stays usable.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

// May be used from any thread, cancel() and cancelled() also from signal handlers. It cannot be reset after
// cancel().
class Progress {
 public:
  // whole: the progress of larger work, with which this one is cancelled. It outlives this one. Null: none.
  explicit Progress(const Progress* whole = nullptr) : whole_(whole) {}

  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool cancelled() const noexcept {
    return cancelled_.load(std::memory_order_relaxed) || (whole_ && whole_->cancelled());
  }

  // The current phase: "read", "build", "render", "write" ... Empty before the work begins.
  [[nodiscard]] const char* phase() const noexcept { return phase_.load(std::memory_order_acquire); }
  // The done share of the phase, 0 to 1.
  [[nodiscard]] double fraction() const noexcept {
    const double total = total_.load(std::memory_order_relaxed);
    return total > 0.0 ? std::clamp(done_.load(std::memory_order_relaxed) / total, 0.0, 1.0) : 0.0;
  }

  // For the code that does the work. `phase` is a string literal. Steps may have any size and be done in
  // parts.
  void begin(const char* phase, double steps) noexcept {
    done_.store(0.0, std::memory_order_relaxed);
    total_.store(steps, std::memory_order_relaxed);
    phase_.store(phase, std::memory_order_release);
  }
  void advance(double steps) noexcept { done_.fetch_add(steps, std::memory_order_relaxed); }

 private:
  const Progress* const whole_;
  std::atomic<bool> cancelled_{false};
  std::atomic<const char*> phase_{""};
  std::atomic<double> done_{0.0}, total_{0.0};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

// The same for a pointer that may be null.
inline void throw_if_cancelled(const Progress* progress) {
  if (progress && progress->cancelled()) throw Cancelled();
}
inline void begin_phase(Progress* progress, const char* phase, double steps) {
  throw_if_cancelled(progress);
  if (progress) progress->begin(phase, steps);
}
// Called after each piece of work, many times a second. Throws Cancelled.
inline void advance(Progress* progress, double steps = 1.0) {
  throw_if_cancelled(progress);
  if (progress) progress->advance(steps);
}

}  // namespace pinocchio
