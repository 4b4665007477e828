#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/parallel/tiles.h"
#include "core/trace/trace_options.h"
#include "core/trace/view_params.h"
#include "pinocchio/image.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// What a reference is made of.
struct ReferenceView {
  Scene scene;
  View view;
  int depth = 8;  // most bounces; shadows are always traced
  TraceOptions options{};

  friend bool operator==(const ReferenceView&, const ReferenceView&) = default;
};

// The precise picture (core/reference) of what is looked at, made in the background on threads of low
// priority while frames are drawn: first one pixel in 8 x 8, shown as squares, then one in 4 x 4, in 2 x 2,
// and all, each time tile by tile. One thread's object; no call waits for the background's work but the
// destructor, which waits for the pixels begun.
class ProgressiveReference {
 public:
  explicit ProgressiveReference(int threads = 1);
  ~ProgressiveReference();
  ProgressiveReference(const ProgressiveReference&) = delete;
  ProgressiveReference& operator=(const ProgressiveReference&) = delete;

  // From now on of this view; the one before is dropped at once. The same view again goes on as it is.
  void show(const ReferenceView& view);
  // Nothing is made any more until show().
  void stop();

  struct Progress {
    const Image<glm::vec4>& color;  // RGBA, linear, of the part; alpha 0: not there yet, or nothing is hit
    double share = 0.0;             // of the pixels that are exact, 0 to 1
    bool changed = false;           // since the last poll
  };
  // The newest of it. Throws what went wrong in the background (out of memory, no thread). Valid until the
  // next call.
  [[nodiscard]] Progress poll();

 private:
  struct Job;
  class Artist;
  void work(const std::stop_token& stop);

  int threads_;
  std::unique_ptr<ReferenceView> view_;  // null: none
  Image<glm::vec4> shown_;
  bool shown_is_clear_ = true;

  std::mutex mutex_;  // of wanted_
  std::condition_variable_any wake_;
  std::shared_ptr<Job> wanted_;  // newest; null: none
  std::jthread thread_;          // last: ends first
};

}  // namespace pinocchio
