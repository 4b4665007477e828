// The panel Frame times: graphs, bytes, rays, and the reasons for the settings.
#include <algorithm>
#include <string>

#include "app/window/overlay/parts.h"
#include "hybrid/settings/explain.h"

namespace pinocchio::app {
namespace {

std::string megabytes(std::size_t bytes) {
  return format("%.2f MB", bytes * 1e-6);
}

std::string count_text(std::uint64_t count) {
  if (count < 10'000) return std::to_string(count);
  return format("%.2f M", count * 1e-6);
}

// Fits 19 of 20 values, so that one slow frame, which compiles shaders, does not flatten the graph.
float height_of(std::vector<float> values) {
  if (values.empty()) return 1.0f;
  const auto nearly_last = values.begin() + values.size() * 19 / 20;
  std::nth_element(values.begin(), nearly_last, values.end());
  return std::max(1.3f * *nearly_last, 1e-3f);
}

void graph(const char* id, const std::vector<float>& values, float height, ImVec4 color) {
  ImGui::PushStyleColor(ImGuiCol_PlotLines, color);
  ImGui::PlotLines(id, values.data(), values.size(), 0, nullptr, 0.0f, height_of(values),
                   ImVec2(ImGui::GetContentRegionAvail().x, height));
  ImGui::PopStyleColor();
}

void draw_times(const Model& model, float scale) {
  const std::vector<float> frames = model.history.frame_ms();
  const float frame_ms = median_of_newest(frames, kMedianOf);
  const float latency_ms = median_of_newest(model.history.latency_ms(), kMedianOf);
  const FrameRecord newest = model.history.empty() ? FrameRecord{} : model.history.records().back();
  row("from picture to picture", format("%.1f ms", frame_ms), "median of the last 20 frames");
  row("measured rate", format("%.1f frames/s", model.history.rate()), "frames in the last second of drawing");
  graph("##frame", frames, 40.0f * scale, kAccent);
  tooltip("time from one picture to the next, oldest at the left");
  row("latency",
      format("%.1f ms, %d frame%s", latency_ms, newest.latency_frames, newest.latency_frames == 1 ? "" : "s"),
      "from reading the camera to handing its picture to the display; in frames: "
      "pictures begun in between");
  if (newest.age_frames > 0)
    row("shadows and mirrors",
        format("%d frame%s late", newest.age_frames, newest.age_frames == 1 ? "" : "s"),
        "exchange reproject: shadows and mirrors of an earlier frame are warped to this one");
}

void draw_stages(const Model& model) {
  const float height = ImGui::GetTextLineHeight();
  if (!ImGui::BeginTable("stages", 3, ImGuiTableFlags_None)) return;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed,
                          ImGui::CalcTextSize("trace reflections ").x);
  ImGui::TableSetupColumn("graph", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("0000.00 ms").x);
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    const std::vector<float> values = model.history.stage_ms(stage);
    if (std::ranges::all_of(values, [](float ms) { return ms <= 0.0f; })) continue;  // it does not run
    const ImVec4 color = lane_color(lane_of(stage, model.drawn));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(color, "%s", stage_label(stage));
    tooltip("median of the last 20 frames; colours show the processors, as in the timeline");
    ImGui::TableNextColumn();
    ImGui::PushID(i);
    graph("##stage", values, height, color);
    ImGui::PopID();
    ImGui::TableNextColumn();
    const std::string text = format("%.2f ms", median_of_newest(values, kMedianOf));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetColumnWidth() -
                         ImGui::CalcTextSize(text.c_str()).x);
    ImGui::TextUnformatted(text.c_str());
  }
  ImGui::EndTable();
}

void draw_traffic(const FrameRecord& record) {
  row("GPU to CPU, a frame", megabytes(record.bytes_to_cpu()),
      "all buffers that the last frame sent in this direction");
  row("CPU to GPU, a frame", megabytes(record.bytes_to_gpu()),
      "all buffers that the last frame sent in this direction");
  for (std::size_t i = 0; i < kChannelNames.size(); ++i) {
    if (record.bytes[i] == 0) continue;
    const std::string name = "   " + std::string(kChannelNames[i]);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
    row(name.c_str(), megabytes(record.bytes[i]),
        goes_to_cpu(static_cast<Channel>(i)) ? "to the CPU" : "to the GPU");
    ImGui::PopStyleColor();
  }
}

void draw_rays(const FrameRecord& record) {
  const RayCounts& rays = record.rays;
  if (rays.primary > 0)
    row("primary rays", count_text(rays.primary),
        "from the camera; none where the GPU finds the visible triangles");
  if (rays.shadow > 0) row("shadow rays", count_text(rays.shadow), "from visible points to the lights");
  if (rays.reflection > 0) row("reflected rays", count_text(rays.reflection), "from mirrors");
  if (rays.refraction > 0) row("refracted rays", count_text(rays.refraction), "through glass");
  if (rays.indirect > 0) row("indirect rays", count_text(rays.indirect), "between matt surfaces");
  const double ms = record[Stage::trace_shadow].ms() + record[Stage::trace_reflection].ms();
  const double traced = rays.shadow + rays.reflection + rays.refraction + rays.indirect;
  if (ms > 0.0)
    row("traced", format("%.1f M rays/s", traced / ms * 1e-3),
        "secondary rays, over the time of tracing them");
}

}  // namespace

void draw_figures(Model& model, float scale) {
  if (model.history.empty()) return paragraph("no frame was drawn with these settings yet");
  draw_times(model, scale);
  draw_stages(model);
  ImGui::Separator();
  draw_traffic(model.history.records().back());
  ImGui::Separator();
  draw_rays(model.history.records().back());
  const bool open = ImGui::CollapsingHeader("Why it is drawn this way");
  tooltip("the values of settings that nobody set, and the reasons");
  if (open)
    for (const std::string& line : explain(model.stats, model.drawn)) paragraph(line);
}

}  // namespace pinocchio::app
