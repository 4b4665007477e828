// The panel Timeline: the stages of the last frames, a row for each processor.
#include <algorithm>
#include <array>
#include <string>

#include "app/window/overlay/parts.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

constexpr int kMostFramesShown = 60;
// In the order of Lane.
struct LaneRow {
  const char* name;
  ImVec4 color;
};
const std::array<LaneRow, 4> kLanes{{{"GPU", {0.47f, 0.80f, 0.52f, 1.0f}},
                                     {"transfer", {0.50f, 0.70f, 0.95f, 1.0f}},
                                     {"CPU", {0.98f, 0.68f, 0.34f, 1.0f}},
                                     {"display", {0.72f, 0.66f, 0.88f, 1.0f}}}};

// Places times and rows on the screen.
struct Chart {
  ImVec2 lo, size;
  double begin_s, end_s;
  float row_height;

  [[nodiscard]] float x(double at_s) const {
    const double share = (at_s - begin_s) / (end_s - begin_s);
    return lo.x + as_float(std::clamp(share, 0.0, 1.0)) * size.x;
  }
  [[nodiscard]] float y(Lane lane) const { return lo.y + as_float(lane) * row_height; }
};

// Frames differ in brightness, so that each can be followed across the rows.
ImU32 color_of(Lane lane, std::uint64_t frame, float alpha) {
  constexpr std::array<float, 3> kShades{1.0f, 0.74f, 0.52f};
  const ImVec4 c = lane_color(lane);
  const float shade = kShades[frame % kShades.size()];
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c.x * shade, c.y * shade, c.z * shade, alpha));
}

void draw_span(const Chart& chart, const FrameRecord& record, Stage stage, Lane lane) {
  const Span& span = record[stage];
  if (span.end_s <= span.begin_s || span.end_s <= chart.begin_s) return;
  // The readback of one frame overlaps the next one's, and a pose is made while another is traced: each has
  // its half of the row.
  const bool travels = stage == Stage::readback || stage == Stage::pose || stage == Stage::trees;
  const float height = (travels ? 0.5f : 1.0f) * (chart.row_height - 4.0f);
  const float top = travels && record.number % 2 == 1 ? height : 0.0f;
  const ImVec2 lo(chart.x(span.begin_s), chart.y(lane) + 2.0f + top);
  const ImVec2 hi(std::max(chart.x(span.end_s), lo.x + 1.0f), lo.y + height);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(lo, hi, color_of(lane, record.number, travels ? 0.4f : 1.0f), 2.0f);
  const std::string name(stage_label(stage));
  const std::string label = name + " " + std::to_string(record.number);
  for (const std::string& text : {label, name}) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    if (travels || extent.x + 6.0f > hi.x - lo.x) continue;
    const ImVec2 at(lo.x + 3.0f, 0.5f * (lo.y + hi.y - extent.y));
    list.AddText(at, IM_COL32(10, 10, 12, 255), text.c_str());
    break;
  }
  if (ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
      ImGui::IsMouseHoveringRect(lo, hi))
    ImGui::SetTooltip("%s of frame %llu: %.2f ms", name.c_str(),
                      static_cast<unsigned long long>(record.number), span.ms());
}

// From the end of one stage to the stage that waits for it.
void draw_arrow(const Chart& chart, double from_s, Lane from, double to_s, Lane to) {
  if (from_s <= chart.begin_s || to_s <= 0.0 || from == to) return;
  const float middle = 0.5f * chart.row_height;
  const ImVec2 a(chart.x(from_s), chart.y(from) + middle), b(chart.x(to_s), chart.y(to) + middle);
  ImGui::GetWindowDrawList()->AddLine(a, b, IM_COL32(255, 255, 255, 150), 1.0f);
  ImGui::GetWindowDrawList()->AddCircleFilled(b, 2.5f, IM_COL32(255, 255, 255, 200));
}

void draw_frame(const Chart& chart, const FrameRecord& record, const Settings& settings) {
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    draw_span(chart, record, stage, lane_of(stage, settings));
  }
}

void draw_waits(const Chart& chart, const FrameRecord& record, const Settings& settings) {
  const bool shadow = record[Stage::trace_shadow].end_s > 0.0;
  const bool reflection = record[Stage::trace_reflection].end_s > 0.0;
  if (!shadow && !reflection) return;
  const Span& first = record[shadow ? Stage::trace_shadow : Stage::trace_reflection];
  const Span& last = record[reflection ? Stage::trace_reflection : Stage::trace_shadow];
  if (record[Stage::readback].end_s > 0.0)
    draw_arrow(chart, record[Stage::raster].end_s, lane_of(Stage::raster, settings), first.begin_s,
               Lane::cpu);
  if (record[Stage::upload].end_s <= 0.0) return;
  draw_arrow(chart, last.end_s, Lane::cpu, record[Stage::upload].begin_s, Lane::exchange);
  draw_arrow(chart, record[Stage::upload].end_s, Lane::exchange, record[Stage::composite].begin_s,
             lane_of(Stage::composite, settings));
}

}  // namespace

Lane lane_of(Stage stage, const Settings& settings) {
  if (const std::optional<Processor> processor = processor_of(stage, settings))
    return *processor == Processor::gpu ? Lane::gpu : Lane::cpu;
  return stage == Stage::present ? Lane::window : Lane::exchange;
}

const char* stage_label(Stage stage) {
  constexpr std::array<const char*, kStageNames.size()> kLabels{
      "pose",   "build trees", "rasterize", "read back", "trace shadows", "trace reflections",
      "upload", "composite",   "present"};
  return kLabels[as_size(stage)];
}

ImVec4 lane_color(Lane lane) {
  return kLanes[as_size(lane)].color;
}

namespace {

void draw_timeline_controls(Model& model) {
  TimelineView& view = model.timeline;
  if (button(view.paused ? "Continue" : "Pause",
             view.paused ? "show the newest frames again" : "keep these frames")) {
    view.paused = !view.paused;
    view.back = 0;
    view.records.assign(model.history.records().begin(), model.history.records().end());
  }
  ImGui::SameLine();
  if (button(" - ", "show more frames (wheel)")) ++view.frames;
  ImGui::SameLine();
  if (button(" + ", "show fewer frames (wheel)")) --view.frames;
  ImGui::SameLine();
}

void handle_pointer(TimelineView& view, const Chart& chart) {
  ImGui::SetCursorScreenPos(chart.lo);
  ImGui::InvisibleButton("chart", ImVec2(std::max(chart.size.x, 1.0f), std::max(chart.size.y, 1.0f)));
  if (ImGui::IsItemHovered() && ImGui::GetIO().MouseWheel != 0.0f)
    view.frames -= ImGui::GetIO().MouseWheel > 0.0f ? 1 : -1;
  const float frame_width = chart.size.x / view.frames;
  if (ImGui::IsItemActive() && view.paused) {
    const float dragged = ImGui::GetMouseDragDelta(0, 0.0f).x / std::max(frame_width, 1.0f);
    if (const int frames = dragged; frames != 0) {
      view.back += frames;
      ImGui::ResetMouseDragDelta(0);
    }
  }
}

void draw_lanes(const Chart& chart, float x) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < kLanes.size(); ++i) {
    const auto& [name, color] = kLanes[i];
    const float y = chart.y(static_cast<Lane>(i));
    list.AddRectFilled({chart.lo.x, y + 1.0f}, {chart.lo.x + chart.size.x, y + chart.row_height - 1.0f},
                       IM_COL32(255, 255, 255, 12), 2.0f);
    list.AddText({x, y + 0.5f * (chart.row_height - ImGui::GetTextLineHeight())},
                 ImGui::ColorConvertFloat4ToU32(color), name);
    ImGui::LogText("%s ", name);
  }
}

}  // namespace

void draw_timeline(Model& model, float scale) {
  TimelineView& view = model.timeline;
  draw_timeline_controls(model);
  const std::vector<FrameRecord> now(model.history.records().begin(), model.history.records().end());
  const std::vector<FrameRecord>& records = view.paused ? view.records : now;
  const int count = records.size();
  view.frames = std::clamp(view.frames, 1, kMostFramesShown);
  view.back = std::clamp(view.back, 0, std::max(count - view.frames, 0));
  const int last = count - (view.paused ? view.back : 0), first = std::max(last - view.frames, 0);
  const auto at = [&](int i) -> const FrameRecord& { return records[as_size(i)]; };
  const double begin_s = count == 0 ? 0.0 : at(first).frame.begin_s;
  const double end_s = count == 0 ? 1.0 : std::max(at(last - 1).frame.end_s, begin_s + 1e-4);
  ImGui::Text("%d frame%s, %.1f ms%s", last - first, last - first == 1 ? "" : "s", 1e3 * (end_s - begin_s),
              view.paused ? ", paused" : "");
  tooltip(
      "frames differ in brightness; a line runs from a stage to the stage that waits for it; in a gap a "
      "processor has no work. Times without drawing are left out");
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float names = ImGui::CalcTextSize("transfer  ").x, width = ImGui::GetContentRegionAvail().x;
  const float height = 100.0f * scale;
  const Chart chart{.lo = {corner.x + names, corner.y},
                    .size = {std::max(width - names, 1.0f), height},
                    .begin_s = begin_s,
                    .end_s = end_s,
                    .row_height = height / kLanes.size()};
  draw_lanes(chart, corner.x);
  handle_pointer(view, chart);
  for (int i = first; i < last; ++i) draw_frame(chart, at(i), model.drawn);
  for (int i = first; i < last; ++i) draw_waits(chart, at(i), model.drawn);
}

}  // namespace pinocchio::app
