#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/trace/passes.h"
#include "gl/timer.h"

namespace pinocchio {

// The stages of a frame, in the order a frame goes through them; names as in the figures.
enum class Stage { raster, readback, trace_shadow, trace_reflection, upload, composite, present };
inline constexpr std::array<std::string_view, 7> kStageNames{
    "raster", "readback", "trace_shadow", "trace_reflection", "upload", "composite", "present"};

// What travels: the first four from GPU to CPU, the others back.
enum class Transfer { ids, normals, gbuffer, phong, traced_ids, mask, reflection, picture };
inline constexpr std::array<std::string_view, 8> kTransferNames{
    "ids", "normals", "gbuffer", "phong", "traced_ids", "mask", "reflection", "picture"};
[[nodiscard]] inline bool goes_to_cpu(Transfer transfer) {
  return transfer < Transfer::traced_ids;
}

// The steady clock, seconds, to which gl::GpuClock turns the GPU's: the one time base of all stages.
[[nodiscard]] inline double now_s() {
  return gl::steady_now_s();
}

// When something was done.
struct Span {
  double begin_s = 0.0, end_s = 0.0;

  [[nodiscard]] double ms() const { return 1e3 * (end_s - begin_s); }
};

// What one frame cost.
struct FrameRecord {
  std::uint64_t number = 0;                       // of the frame, in the order they were asked for
  std::array<Span, kStageNames.size()> stages{};  // empty: the plan has no such stage
  Span frame;                                     // camera sampled to picture delivered
  int latency_frames = 0;                         // frames begun between the two
  int age_frames = 0;                             // how much older the mask and reflection shown are
  std::array<std::size_t, kTransferNames.size()> bytes{};
  RayCounts rays;

  [[nodiscard]] Span& operator[](Stage stage) { return stages[static_cast<std::size_t>(stage)]; }
  [[nodiscard]] const Span& operator[](Stage stage) const { return stages[static_cast<std::size_t>(stage)]; }
  [[nodiscard]] std::size_t& operator[](Transfer transfer) {
    return bytes[static_cast<std::size_t>(transfer)];
  }
  [[nodiscard]] std::size_t operator[](Transfer transfer) const {
    return bytes[static_cast<std::size_t>(transfer)];
  }
  // Of all that goes to the CPU, or to the GPU.
  [[nodiscard]] std::size_t bytes_to_cpu() const { return sum_bytes(true); }
  [[nodiscard]] std::size_t bytes_to_gpu() const { return sum_bytes(false); }

 private:
  [[nodiscard]] std::size_t sum_bytes(bool to_cpu) const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      if (goes_to_cpu(static_cast<Transfer>(i)) == to_cpu) sum += bytes[i];
    return sum;
  }
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
