#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/trace/passes.h"

namespace pinocchio {

// The stages of a frame, in the order a frame goes through them; names as in the figures.
enum class Stage { raster, readback, trace_shadow, trace_reflection, upload, composite, present };
inline constexpr std::array<std::string_view, 7> kStageNames{
    "raster", "readback", "trace_shadow", "trace_reflection", "upload", "composite", "present"};

// The steady clock, seconds: the one time base of CPU and GPU stages.
[[nodiscard]] inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// When something was done.
struct Span {
  double begin_s = 0.0, end_s = 0.0;

  [[nodiscard]] double ms() const { return 1e3 * (end_s - begin_s); }
};

// What one frame cost.
struct FrameRecord {
  std::uint64_t number = 0;                          // of the frame, in the order they were asked for
  std::array<Span, kStageNames.size()> stages{};     // empty: the plan has no such stage
  Span frame;                                        // camera sampled to picture delivered
  int latency_frames = 0;                            // frames begun between the two
  std::size_t id_bytes = 0;                          // GPU to CPU
  std::size_t mask_bytes = 0, reflection_bytes = 0;  // CPU to GPU
  RayCounts rays;

  [[nodiscard]] Span& operator[](Stage stage) { return stages[static_cast<std::size_t>(stage)]; }
  [[nodiscard]] const Span& operator[](Stage stage) const { return stages[static_cast<std::size_t>(stage)]; }
};

// Notes when a stage begins and ends on the CPU.
class StageTimer {
 public:
  StageTimer(FrameRecord& record, Stage stage) : span_(record[stage]) { span_.begin_s = now_s(); }
  ~StageTimer() { span_.end_s = now_s(); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  Span& span_;
};

}  // namespace pinocchio
