// What looks closely: the pixel under the pointer, materials, and files.
#include <algorithm>
#include <filesystem>
#include <string>

#include "app/window/overlay_parts.h"

namespace pinocchio::app {
namespace {

std::string rgb_text(const glm::vec3& v) {
  return format("%.4f, %.4f, %.4f", static_cast<double>(v.x), static_cast<double>(v.y),
                static_cast<double>(v.z));
}

std::string xyz_text(const glm::vec3& v) {
  return format("%.3f, %.3f, %.3f", static_cast<double>(v.x), static_cast<double>(v.y),
                static_cast<double>(v.z));
}

std::string name_of(const Mesh& mesh, std::size_t material) {
  const std::string& name = mesh.materials[material].name;
  return name.empty() ? "material " + std::to_string(material) : name;
}

void draw_cost(const Model& model, const PixelReport& pixel) {
  row("bounces", std::to_string(pixel.bounces), "how deep mirrored and refracted rays go here");
  row("rays",
      format("%llu shadow, %llu mirrored, %llu refracted", static_cast<unsigned long long>(pixel.rays.shadow),
             static_cast<unsigned long long>(pixel.rays.reflection),
             static_cast<unsigned long long>(pixel.rays.refraction)),
      "that the CPU fires for one sample of this pixel");
  if (model.history.empty()) return;
  const FrameRecord& record = model.history.records().back();
  const double pixels = std::max(1.0, static_cast<double>(model.picture_size.x) * model.picture_size.y);
  row("bytes to the CPU", format("%.2f", static_cast<double>(record.bytes_to_cpu()) / pixels),
      "for a pixel of the last frame, on average");
  row("bytes to the GPU", format("%.2f", static_cast<double>(record.bytes_to_gpu()) / pixels),
      "for a pixel of the last frame, on average");
}

bool edit_color(const char* name, glm::vec3& color, const std::string& help) {
  label(name, help);
  ImGui::PushID(name);
  const bool changed =
      ImGui::ColorEdit3("##color", &color.x,
                        ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_NoOptions);
  ImGui::PopID();
  tooltip(help);
  color = glm::max(color, glm::vec3(0.0f));
  return changed;
}

bool edit_material(Material& m) {
  bool changed = edit_color("diffuse", m.diffuse, "kd: scattered light, linear colour");
  if (changed) m.ambient = m.diffuse;
  changed = edit_color("specular", m.specular, "ks: the highlight's colour") || changed;
  changed = slider("shininess", m.shininess, 1.0f, 256.0f, format("%.0f", static_cast<double>(m.shininess)),
                   "exponent of the highlight: higher is smaller and sharper") ||
            changed;
  changed = edit_color("mirror", m.reflectance, "how much a mirrored ray counts; 0: no mirror") || changed;
  changed = slider("index", m.ior, 1.0f, 3.0f, format("%.2f", static_cast<double>(m.ior)),
                   "index of refraction of the inside, for what is transparent") ||
            changed;
  return changed;
}

}  // namespace

void draw_pixel(Model& model, float) {
  if (!model.pixel) return paragraph("Put the pointer on the picture. The tree has to be built.");
  const PixelReport& pixel = *model.pixel;
  row("pixel", format("%d, %d", pixel.pixel.x, pixel.pixel.y), "of the picture, from the upper left");
  row("colour", rgb_text(pixel.color), "linear light, one sample at the pixel's centre");
  if (pixel.triangle == kNoTriangle) return paragraph("nothing is seen here");
  row("triangle", std::to_string(pixel.triangle), "its id, as in the EXR");
  row("material", name_of(*model.scene.mesh, pixel.material), "Ctrl + click edits it");
  row("depth", format("%.4g", static_cast<double>(pixel.depth)), "along the view axis, scene units");
  row("position", xyz_text(pixel.position), "x, y, z, scene units");
  row("normal", xyz_text(pixel.normal), "of the shading, unit length");
  ImGui::Separator();
  for (const PixelReport::LightShare& light : pixel.lights)
    row((light.name + (light.reaches ? "" : ": in shadow")).c_str(), rgb_text(light.light),
        "light that it brings this pixel, linear");
  row("ambient, emitted", rgb_text(pixel.ambient), "light without any lamp");
  row("mirrored", rgb_text(pixel.mirrored), "light by reflected and refracted rays");
  ImGui::Separator();
  draw_cost(model, pixel);
  if (model.pixel_error)
    row("error", format("%.6f", *model.pixel_error),
        "largest difference of a colour from the reference here");
}

void draw_materials(Model& model, float scale) {
  if (!model.has_scene()) return paragraph("no scene");
  const Mesh& mesh = *model.scene.mesh;
  model.material = std::clamp(model.material, 0, static_cast<int>(mesh.materials.size()) - 1);
  ImGui::BeginChild("list", ImVec2(0.0f, 6.0f * ImGui::GetTextLineHeightWithSpacing()), true);
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (line_of_list(name_of(mesh, i).c_str(), model.material == static_cast<int>(i)))
      model.material = static_cast<int>(i);
    ImGui::PopID();
    tooltip("edit this material; Ctrl + click in the picture picks one");
  }
  ImGui::EndChild();
  if (model.material < 0) return;
  ImGui::Dummy(ImVec2(0.0f, 2.0f * scale));
  Material material = mesh.materials[static_cast<std::size_t>(model.material)];
  if (edit_material(material)) model.edited_material = material;
}

void draw_files(Model& model, float) {
  FileList& files = model.files;
  if (files.folder.empty()) {
    std::error_code unknown;
    files.go_to(model.has_scene() ? std::filesystem::absolute(model.scene.source, unknown).parent_path()
                                  : std::filesystem::current_path(unknown));
  }
  paragraph(files.folder.string());
  ImGui::BeginChild("files", ImVec2(0.0f, 11.0f * ImGui::GetTextLineHeightWithSpacing()), true);
  std::filesystem::path go_to;
  if (line_of_list("..")) go_to = files.folder.parent_path();
  tooltip("the folder above");
  for (const FolderEntry& entry : files.entries) {
    const std::string name = entry.path.filename().string() + (entry.is_folder ? "/" : "");
    if (line_of_list(name.c_str())) {
      if (entry.is_folder)
        go_to = entry.path;
      else
        model.file_to_open = entry.path.string();
    }
    tooltip(entry.is_folder ? "look into this folder" : "open this scene");
  }
  ImGui::EndChild();
  if (!go_to.empty()) files.go_to(go_to);
  if (model.recent.empty()) return;
  ImGui::TextUnformatted("Recent");
  for (const std::string& file : model.recent) {
    if (line_of_list(file.c_str())) model.file_to_open = file;
    tooltip("open it again");
  }
}

}  // namespace pinocchio::app
