#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "core/parallel/tiles.h"
#include "core/trace/rays/trace_options.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/image.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// The picture that a reference is made of.
struct ReferenceView {
  Scene scene;
  View view;
  int depth = 8;  // most bounces; shadows are always traced
  TraceOptions options{};

  friend bool operator==(const ReferenceView&, const ReferenceView&) = default;
};

// The precise picture (core/reference) of a view, made in the background on threads of low priority while
// frames are drawn: first one pixel in 8 x 8, shown as squares, then one in 4 x 4, in 2 x 2, and all, each
// time tile by tile. Used by one thread. No call waits for the background except the destructor, which waits
// for the pixels that were begun.
class ProgressiveReference {
 public:
  explicit ProgressiveReference(int threads = 1);
  ~ProgressiveReference();
  ProgressiveReference(const ProgressiveReference&) = delete;
  ProgressiveReference& operator=(const ProgressiveReference&) = delete;

  // Starts this view and drops the one before; does nothing if the view is the same.
  void show(const ReferenceView& view);
  // Makes nothing until the next show().
  void stop();

  struct Progress {
    const Image<glm::vec4>& color;  // RGBA, linear, of the part; alpha 0: not made yet, or nothing is hit
    double share = 0.0;             // exact pixels, 0 to 1
    bool changed = false;           // since the last poll
  };
  // The newest state, valid until the next call. Throws errors of the background (out of memory, no thread).
  [[nodiscard]] Progress poll();

 private:
  struct Job;
  class Painter;
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
