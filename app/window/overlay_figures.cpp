// What the last frames cost: graphs, bytes, rays, and why they are drawn as they are.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "app/window/overlay_parts.h"
#include "hybrid/settings/explain.h"

namespace pinocchio::app {
namespace {

constexpr std::size_t kMedianOf = 20;  // frames

std::string megabytes(std::size_t bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f MB", static_cast<double>(bytes) * 1e-6);
  return text.data();
}

std::string count_text(std::uint64_t count) {
  std::array<char, 32> text{};
  if (count < 10'000) {
    std::snprintf(text.data(), text.size(), "%llu", static_cast<unsigned long long>(count));
  } else {
    std::snprintf(text.data(), text.size(), "%.2f M", static_cast<double>(count) * 1e-6);
  }
  return text.data();
}

// High enough for nearly all: one slow frame (shaders being compiled) does not flatten the rest.
float height_of(std::vector<float> values) {
  if (values.empty()) return 1.0f;
  const auto nearly_last = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 19 / 20);
  std::nth_element(values.begin(), nearly_last, values.end());
  return std::max(1.3f * *nearly_last, 1e-3f);
}

void graph(const char* id, const std::vector<float>& values, float height, ImVec4 color) {
  ImGui::PushStyleColor(ImGuiCol_PlotLines, color);
  ImGui::PlotLines(id, values.data(), static_cast<int>(values.size()), 0, nullptr, 0.0f, height_of(values),
                   ImVec2(ImGui::GetContentRegionAvail().x, height));
  ImGui::PopStyleColor();
}

// Two columns: a name, and a value at the right edge.
void row(const char* name, const std::string& value) {
  ImGui::TextUnformatted(name);
  const float width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
  ImGui::TextUnformatted(value.c_str());
}

void draw_times(const Model& model, float scale) {
  const std::vector<float> frames = model.history.frame_ms();
  const float frame_ms = median_of_newest(frames, kMedianOf);
  const float latency_ms = median_of_newest(model.history.latency_ms(), kMedianOf);
  const int late = model.history.empty() ? 0 : model.history.records().back().latency_frames;
  const int age = model.history.empty() ? 0 : model.history.records().back().age_frames;
  ImGui::Text("frame %.1f ms", static_cast<double>(frame_ms));
  std::array<char, 32> fps{};
  std::snprintf(fps.data(), fps.size(), "%.1f fps",
                frame_ms > 0.0f ? 1e3 / static_cast<double>(frame_ms) : 0.0);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(fps.data()).x);
  ImGui::TextUnformatted(fps.data());
  graph("##frame", frames, 46.0f * scale, ImVec4(0.98f, 0.72f, 0.38f, 1.0f));
  ImGui::Text("latency %.1f ms, %d frame%s%s", static_cast<double>(latency_ms), late, late == 1 ? "" : "s",
              model.settings.vsync ? ", with vsync" : ", no vsync");
  if (age > 0) ImGui::Text("shadows and reflections %d frame%s older", age, age == 1 ? "" : "s");
}

void draw_stages(const Model& model) {
  const float height = ImGui::GetTextLineHeight();
  if (!ImGui::BeginTable("stages", 3, ImGuiTableFlags_None)) return;
  const float name_width = ImGui::CalcTextSize("trace_reflection ").x,
              value_width = ImGui::CalcTextSize("0000.00").x;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, name_width);
  ImGui::TableSetupColumn("graph", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed, value_width);
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    const std::vector<float> values = model.history.stage_ms(stage);
    const float ms = median_of_newest(values, kMedianOf);
    const ImVec4 color = lane_color(lane_of(stage, model.drawn));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(ms > 0.0f ? color : ImGui::GetStyle().Colors[ImGuiCol_TextDisabled], "%s",
                       std::string(kStageNames[i]).c_str());
    ImGui::TableNextColumn();
    ImGui::PushID(static_cast<int>(i));
    graph("##stage", values, height, color);
    ImGui::PopID();
    ImGui::TableNextColumn();
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.2f", static_cast<double>(ms));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetColumnWidth() -
                         ImGui::CalcTextSize(text.data()).x);
    ImGui::TextUnformatted(ms > 0.0f ? text.data() : "");
  }
  ImGui::EndTable();
}

void draw_traffic(const FrameRecord& record) {
  row("GPU to CPU", megabytes(record.bytes_to_cpu()));
  row("CPU to GPU", megabytes(record.bytes_to_gpu()));
  for (std::size_t i = 0; i < kChannelNames.size(); ++i) {
    if (record.bytes[i] == 0) continue;
    const std::string name = "   " + std::string(kChannelNames[i]);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
    row(name.c_str(), megabytes(record.bytes[i]));
    ImGui::PopStyleColor();
  }
}

void draw_rays(const FrameRecord& record) {
  const RayCounts& rays = record.rays;
  if (rays.primary > 0) row("primary rays", count_text(rays.primary));
  row("shadow rays", count_text(rays.shadow));
  row("reflected, refracted", count_text(rays.reflection) + ", " + count_text(rays.refraction));
  const double ms = record[Stage::trace_shadow].ms() + record[Stage::trace_reflection].ms();
  const auto traced = static_cast<double>(rays.shadow + rays.reflection + rays.refraction);
  if (ms <= 0.0) return;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f M", traced / ms * 1e-3);
  row("rays a second", text.data());
}

}  // namespace

void draw_figures(const Model& model, float scale) {
  draw_times(model, scale);
  draw_stages(model);
  if (!model.history.empty()) {
    ImGui::Separator();
    draw_traffic(model.history.records().back());
    ImGui::Separator();
    draw_rays(model.history.records().back());
  }
  if (model.has_scene() && ImGui::CollapsingHeader("Why so", ImGuiTreeNodeFlags_DefaultOpen)) {
    ImGui::PushTextWrapPos(0.0f);
    for (const std::string& line : explain(model.stats, model.drawn))
      ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
  }
}

}  // namespace pinocchio::app
