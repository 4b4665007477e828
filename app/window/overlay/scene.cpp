// The panel Scene: what the file holds, and its parts, which can be hidden.
#include <algorithm>
#include <filesystem>
#include <string>

#include "app/window/overlay/parts.h"
#include "pinocchio/animation.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

// The file is read again.
void choose_up_axis(Model& model) {
  const int clicked = choose(
      "up axis", "the axis of the file that points up: y in glTF, often z in STL, PLY and OBJ",
      {{"y", "as in glTF"}, {"z", "the scene is turned, so that its z points up"}}, as_size(model.up_axis));
  if (clicked >= 0 && static_cast<UpAxis>(clicked) != model.up_axis)
    model.up_axis_to_use = static_cast<UpAxis>(clicked);
}

void draw_facts(Model& model) {
  const Scene& scene = model.scene;
  const Mesh& mesh = *scene.mesh;
  const auto count = [](const char* name, std::size_t value, const char* help) {
    row(name, std::to_string(value), help);
  };
  row("file", std::filesystem::path(scene.source).filename().string(), scene.source);
  row("size", format("%.2f MB", model.parts.bytes * 1e-6), "of the file, without those that it names");
  count("triangles", mesh.triangles.size(), "also hidden ones");
  count("vertices", mesh.positions.size(), "corners that triangles share count once");
  count("materials", mesh.materials.size(), "F7 shows them");
  if (!scene.variants.empty())
    count("variants", scene.variants.size(), "of the materials; F7 chooses among them");
  count("textures", mesh.textures.size(), "pictures on surfaces");
  count("lights", scene.lights.size(), "F5 shows them");
  count("cameras", scene.cameras.size(), "F6 shows them");
  if (model.playback.all)
    row("animations", format("%zu, %.2f s", model.playback.all->clips.size(), model.playback.all->duration_s),
        "their number, and the length of the longest");
  const glm::vec3 size = model.stats.bounds.extent();
  row("extent", format("%.4g x %.4g x %.4g", size.x, size.y, size.z), "x, y and z, in the scene's units");
  choose_up_axis(model);
  if (model.parts.extensions.empty() && model.parts.warnings.empty()) return;
  ImGui::Separator();
  for (const std::string& name : model.parts.extensions) paragraph(name);
  for (const std::string& warning : model.parts.warnings) paragraph("left out: " + warning);
}

// With all nodes below it.
void set_hidden(Model& model, std::size_t part, bool is_hidden) {
  std::vector<bool>& hidden = model.parts.hidden;
  const bool are_nodes = model.parts.are_nodes;
  std::vector<bool> below(hidden.size(), false);
  for (std::size_t i = part; i < hidden.size(); ++i) {
    const int parent = are_nodes ? model.scene.nodes->nodes[i].parent : -1;
    below[i] = i == part || (parent >= 0 && below[parent]);
    if (below[i]) hidden[i] = is_hidden;
  }
  model.parts.changed = true;
}

void draw_part(Model& model, std::size_t part, const std::string& name, std::size_t triangles, int depth,
               float scale) {
  ImGui::PushID(part);
  ImGui::Indent((1.0f + 12.0f * depth) * scale);
  bool is_shown = !model.parts.hidden[part];
  if (checkbox("##shown", is_shown, "off: this part is hidden")) set_hidden(model, part, !is_shown);
  ImGui::SameLine();
  if (button("only", "show this part alone")) {
    model.parts.hidden.assign(model.parts.hidden.size(), true);
    set_hidden(model, part, false);
  }
  ImGui::SameLine();
  ImGui::TextUnformatted(name.c_str());
  tooltip(std::to_string(triangles) + (triangles == 1 ? " triangle" : " triangles"));
  ImGui::Unindent((1.0f + 12.0f * depth) * scale);
  ImGui::PopID();
}

// Those with triangles, or with such nodes below them.
void draw_nodes(Model& model, float scale) {
  const std::vector<Node>& nodes = model.scene.nodes->nodes;
  std::vector<std::size_t> triangles(nodes.size(), 0);
  for (std::size_t i = nodes.size(); i-- > 0;) {
    triangles[i] += nodes[i].triangles;
    if (nodes[i].parent >= 0) triangles[nodes[i].parent] += triangles[i];
  }
  std::vector<int> depths(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent >= 0) depths[i] = depths[nodes[i].parent] + 1;
    if (triangles[i] == 0) continue;
    const std::string& name = nodes[i].name;
    draw_part(model, i, name.empty() ? "node " + std::to_string(i) : name, triangles[i],
              std::min(depths[i], 8), scale);
  }
}

void draw_by_material(Model& model, float scale) {
  const Mesh& mesh = *model.scene.mesh;
  std::vector<std::size_t> triangles(mesh.materials.size(), 0);
  for (const std::uint32_t material : mesh.triangle_materials) ++triangles[material];
  for (std::size_t i = 0; i < mesh.materials.size(); ++i)
    draw_part(model, i, name_of_material(mesh, i), triangles[i], 0, scale);
}

}  // namespace

void draw_scene(Model& model, float scale) {
  if (!model.has_scene()) return paragraph("no scene");
  draw_facts(model);
  ImGui::Separator();
  const bool are_nodes = model.parts.are_nodes;
  const std::size_t count = are_nodes ? model.scene.nodes->nodes.size() : model.scene.mesh->materials.size();
  if (model.parts.hidden.size() != count) return;  // no scene was shown yet
  ImGui::BeginDisabled(!model.parts.hides());
  if (button("Show all", "no part is hidden")) {
    model.parts.hidden.assign(model.parts.hidden.size(), false);
    model.parts.changed = true;
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::TextUnformatted(are_nodes ? "parts" : "parts by material");
  ImGui::BeginChild("parts", ImVec2(0.0f, 9.0f * ImGui::GetFrameHeightWithSpacing()), true,
                    ImGuiWindowFlags_HorizontalScrollbar);
  if (are_nodes)
    draw_nodes(model, scale);
  else
    draw_by_material(model, scale);
  ImGui::EndChild();
}

}  // namespace pinocchio::app
