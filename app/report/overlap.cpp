#include "app/report/overlap.h"

#include <algorithm>

namespace pinocchio::app {
namespace {

// A processor begins or ends a stage.
struct Edge {
  double at_s;
  bool gpu;
  int step;  // +1, -1
};

}  // namespace

Overlap overlap_of(const std::vector<FrameRecord>& records) {
  if (records.empty()) return {};
  // Poses and trees are made ahead: those of the first frames began before them.
  const double first_s = records.front().frame.begin_s, last_s = records.back().frame.end_s;
  std::vector<Edge> edges;
  for (const FrameRecord& record : records)
    for (std::size_t i = 0; i < record.stages.size(); ++i) {
      const Span& whole = record.stages[i];
      const Span span{std::max(whole.begin_s, first_s), std::min(whole.end_s, last_s)};
      if (!record.processors[i] || span.end_s <= span.begin_s) continue;
      const bool gpu = record.processors[i] == Processor::gpu;
      edges.push_back({span.begin_s, gpu, +1});
      edges.push_back({span.end_s, gpu, -1});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.at_s < b.at_s; });

  Overlap overlap;
  overlap.wall_s = last_s - first_s;
  int gpu = 0, cpu = 0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    (edges[i].gpu ? gpu : cpu) += edges[i].step;
    const double length_s = edges[i + 1].at_s - edges[i].at_s;
    if (gpu > 0) overlap.gpu_s += length_s;
    if (cpu > 0) overlap.cpu_s += length_s;
    if (gpu > 0 && cpu > 0) overlap.both_s += length_s;
  }
  return overlap;
}

}  // namespace pinocchio::app
