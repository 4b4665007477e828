#include "app/report/chrome_trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace pinocchio::app {
namespace {

enum Row { kExchange, kTracer, kGpu };
constexpr std::array<const char*, 3> kRowNames{"exchange (OpenGL thread)", "CPU tracer", "GPU"};
constexpr int kMostTracks = 100;  // of a row

Row row_of(std::optional<Processor> processor) {
  if (!processor) return kExchange;
  return processor == Processor::gpu ? kGpu : kTracer;
}

// A stage of a frame on its track. In whole nanoseconds, as viewers count: rounding later would make slices
// overlap.
struct Slice {
  std::uint64_t frame;
  Stage stage;
  Row row;
  std::int64_t begin_ns, end_ns;
  int track = 0;  // within its row

  [[nodiscard]] int thread() const { return row * kMostTracks + track + 1; }
};

std::vector<Slice> slices_of(const std::vector<FrameRecord>& records) {
  std::vector<Slice> slices;
  double begin_s = records.empty() ? 0.0 : records.front().frame.begin_s;
  for (const FrameRecord& record : records)  // a pose is made before its frame
    for (const Stage stage : {Stage::pose, Stage::trees})
      if (record[stage].end_s > 0.0) begin_s = std::min(begin_s, record[stage].begin_s);
  const auto ns = [begin_s](double s) { return std::int64_t{std::llround(1e9 * (s - begin_s))}; };
  for (const FrameRecord& record : records)
    for (std::size_t i = 0; i < kStageNames.size(); ++i)
      if (const Span& span = record.stages[i]; ns(span.end_s) > ns(span.begin_s))
        slices.push_back({.frame = record.number,
                          .stage = static_cast<Stage>(i),
                          .row = row_of(record.processors[i]),
                          .begin_ns = ns(span.begin_s),
                          .end_ns = ns(span.end_s)});
  return slices;
}

// Viewers drop slices of a thread that overlap: each of them gets a track of its own.
void place(std::vector<Slice>& slices) {
  std::ranges::stable_sort(slices, {}, &Slice::begin_ns);
  std::array<std::vector<std::int64_t>, kRowNames.size()> ends;  // of each track's last slice
  for (Slice& slice : slices) {
    std::vector<std::int64_t>& tracks = ends[slice.row];
    const auto free =
        std::ranges::find_if(tracks, [&](std::int64_t end_ns) { return end_ns <= slice.begin_ns; });
    slice.track = free - tracks.begin();
    if (free == tracks.end())
      tracks.push_back(slice.end_ns);
    else
      *free = slice.end_ns;
  }
}

nlohmann::json event(const char* kind, int thread, const std::string& name) {
  return {{"ph", kind}, {"pid", 1}, {"tid", thread}, {"name", name}};
}

double us(std::int64_t ns) {
  return 1e-3 * ns;
}

void name_threads(const std::vector<Slice>& slices, nlohmann::json& events) {
  std::map<int, const Slice*> threads;
  for (const Slice& slice : slices) threads.emplace(slice.thread(), &slice);
  for (const auto& [thread, slice] : threads) {
    std::string name = kRowNames[slice->row];
    if (slice->track > 0) name += " " + std::to_string(slice->track + 1);
    nlohmann::json named = event("M", thread, "thread_name"),
                   sorted = event("M", thread, "thread_sort_index");
    named["args"]["name"] = name;
    sorted["args"]["sort_index"] = thread;
    events.push_back(std::move(named));
    events.push_back(std::move(sorted));
  }
}

// From a frame's readback to its trace, upload and composite. An arrow binds to the slice at its time.
void add_arrows(const std::vector<Slice>& slices, nlohmann::json& events) {
  std::map<std::uint64_t, std::vector<const Slice*>> ways;
  for (const Slice& slice : slices)
    if (slice.stage > Stage::raster && slice.stage != Stage::present) ways[slice.frame].push_back(&slice);
  for (auto& [frame, way] : ways) {
    std::ranges::stable_sort(way, {}, [](const Slice* slice) { return slice->stage; });
    for (std::size_t i = 0; i < way.size() && way.size() > 1; ++i) {
      nlohmann::json arrow = event(i == 0 ? "s" : i + 1 < way.size() ? "t" : "f", way[i]->thread(), "frame");
      arrow["cat"] = "frame";
      arrow["id"] = frame;
      arrow["ts"] = us((way[i]->begin_ns + way[i]->end_ns) / 2);
      if (i + 1 == way.size()) arrow["bp"] = "e";
      events.push_back(std::move(arrow));
    }
  }
}

}  // namespace

nlohmann::json chrome_trace(const std::vector<FrameRecord>& records) {
  std::vector<Slice> slices = slices_of(records);
  place(slices);
  nlohmann::json events = nlohmann::json::array();
  name_threads(slices, events);
  for (const Slice& slice : slices) {
    nlohmann::json complete = event("X", slice.thread(), std::string(name_of(kStageNames, slice.stage)));
    complete["ts"] = us(slice.begin_ns);
    complete["dur"] = us(slice.end_ns - slice.begin_ns);
    complete["args"]["frame"] = slice.frame;
    events.push_back(std::move(complete));
  }
  add_arrows(slices, events);
  return {{"traceEvents", events}, {"displayTimeUnit", "ms"}};
}

}  // namespace pinocchio::app
