#include "app/chrome_trace.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string>

namespace pinocchio::app {
namespace {

enum Row { kExchange = 1, kTracer, kGpu };

Row row_of(Stage stage) {
  switch (stage) {
    case Stage::raster:
    case Stage::composite:
      return kGpu;
    case Stage::trace_shadow:
    case Stage::trace_reflection:
      return kTracer;
    default:
      return kExchange;
  }
}

nlohmann::json row_name(Row row, const char* name) {
  return {{"ph", "M"},
          {"pid", 1},
          {"tid", static_cast<int>(row)},
          {"name", "thread_name"},
          {"args", {{"name", name}}}};
}

void add_stages(const FrameRecord& record, double begin_s, nlohmann::json& events) {
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const Span& span = record.stages[i];
    if (span.end_s <= span.begin_s) continue;
    events.push_back({{"ph", "X"},
                      {"pid", 1},
                      {"tid", static_cast<int>(row_of(static_cast<Stage>(i)))},
                      {"name", std::string(kStageNames[i])},
                      {"ts", 1e6 * (span.begin_s - begin_s)},
                      {"dur", 1e6 * (span.end_s - span.begin_s)},
                      {"args", {{"frame", record.number}}}});
  }
}

// Arrows bind to the slice that is open at their time.
void add_arrows(const FrameRecord& record, double begin_s, nlohmann::json& events) {
  std::vector<Stage> way;
  for (const Stage stage :
       {Stage::readback, Stage::trace_shadow, Stage::trace_reflection, Stage::upload, Stage::composite})
    if (record[stage].end_s > record[stage].begin_s) way.push_back(stage);
  for (std::size_t i = 0; i < way.size() && way.size() > 1; ++i) {
    const Span& span = record[way[i]];
    nlohmann::json event{{"ph", i == 0               ? "s"
                                : i + 1 < way.size() ? "t"
                                                     : "f"},
                         {"pid", 1},
                         {"tid", static_cast<int>(row_of(way[i]))},
                         {"name", "frame"},
                         {"cat", "frame"},
                         {"id", record.number},
                         {"ts", 1e6 * (0.5 * (span.begin_s + span.end_s) - begin_s)}};
    if (i + 1 == way.size()) event["bp"] = "e";
    events.push_back(std::move(event));
  }
}

}  // namespace

nlohmann::json chrome_trace(const std::vector<FrameRecord>& records) {
  nlohmann::json events = nlohmann::json::array();
  events.push_back(row_name(kExchange, "exchange (OpenGL thread)"));
  events.push_back(row_name(kTracer, "CPU tracer"));
  events.push_back(row_name(kGpu, "GPU"));
  const double begin_s = records.empty() ? 0.0 : records.front().frame.begin_s;
  for (const FrameRecord& record : records) {
    add_stages(record, begin_s, events);
    add_arrows(record, begin_s, events);
  }
  return {{"traceEvents", events}, {"displayTimeUnit", "ms"}};
}

}  // namespace pinocchio::app
