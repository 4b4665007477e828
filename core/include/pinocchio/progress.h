// Long work that can be watched, and ended early. Every function that takes long has a Progress* at the end
// of its arguments or in its options; null, the default, costs nothing:
//
//   Progress progress;                              // outlives the work
//   std::thread watcher([&] { show(progress.phase(), progress.fraction()); });
//   load_scene(file, &warnings, &progress);         // throws Cancelled soon after progress.cancel()
#pragma once

#include <algorithm>
#include <atomic>
#include <stdexcept>

namespace pinocchio {

// Thrown by work whose Progress was cancelled, from the thread that called it. No file is half written, and
// every object is left as good as it was.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

// Safe to use from any thread; cancel() and cancelled() from signal handlers, too. Once cancelled it stays
// so.
class Progress {
 public:
  // whole: of the work that this one's is a part of, cancelled with it; it outlives this one. Null: of none.
  explicit Progress(const Progress* whole = nullptr) : whole_(whole) {}

  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool cancelled() const noexcept {
    return cancelled_.load(std::memory_order_relaxed) || (whole_ && whole_->cancelled());
  }

  // What is being done now: "read", "build", "render", "write" ...; empty before anything has begun.
  [[nodiscard]] const char* phase() const noexcept { return phase_.load(std::memory_order_acquire); }
  // How much of the phase is done, 0 to 1.
  [[nodiscard]] double fraction() const noexcept {
    const double total = total_.load(std::memory_order_relaxed);
    return total > 0.0 ? std::clamp(done_.load(std::memory_order_relaxed) / total, 0.0, 1.0) : 0.0;
  }

  // For those who do the work. `phase` is a string literal; `steps` are of any size, and may be done in
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

// The same where there may be none.
inline void throw_if_cancelled(const Progress* progress) {
  if (progress && progress->cancelled()) throw Cancelled();
}
inline void begin_phase(Progress* progress, const char* phase, double steps) {
  throw_if_cancelled(progress);
  if (progress) progress->begin(phase, steps);
}
// After each piece of work; often enough, that a second is many pieces.
inline void advance(Progress* progress, double steps = 1.0) {
  throw_if_cancelled(progress);
  if (progress) progress->advance(steps);
}

}  // namespace pinocchio
