// The panels Pixel and Files.
#include <algorithm>
#include <filesystem>
#include <string>

#include "app/window/overlay/parts.h"

namespace pinocchio::app {
namespace {

std::string rgb_text(const glm::vec3& v) {
  return format("%.4f, %.4f, %.4f", v.x, v.y, v.z);
}

std::string xyz_text(const glm::vec3& v) {
  return format("%.3f, %.3f, %.3f", v.x, v.y, v.z);
}

void draw_cost(const Model& model, const PixelReport& pixel) {
  row("bounces", std::to_string(pixel.bounces), "most bounces of mirrored and refracted rays here");
  row("rays",
      format("%llu shadow, %llu mirrored, %llu refracted", static_cast<unsigned long long>(pixel.rays.shadow),
             static_cast<unsigned long long>(pixel.rays.reflection),
             static_cast<unsigned long long>(pixel.rays.refraction)),
      "rays that the CPU traces for one sample of this pixel");
  if (model.history.empty()) return;
  const FrameRecord& record = model.history.records().back();
  const double pixels = std::max(1.0, 1.0 * model.picture_size.x * model.picture_size.y);
  row("bytes to the CPU", format("%.2f", record.bytes_to_cpu() / pixels),
      "mean for each pixel of the last frame");
  row("bytes to the GPU", format("%.2f", record.bytes_to_gpu() / pixels),
      "mean for each pixel of the last frame");
}

}  // namespace

void draw_pixel(Model& model, float) {
  if (!model.pixel) return paragraph("Put the pointer on the picture. The tree must be built first.");
  const PixelReport& pixel = *model.pixel;
  row("pixel", format("%d, %d", pixel.pixel.x, pixel.pixel.y), "x, y in the picture, from the upper left");
  row("colour", rgb_text(pixel.color), "linear light, one sample at the pixel's centre");
  if (pixel.triangle == kNoTriangle) return paragraph("no surface is visible here");
  row("triangle", std::to_string(pixel.triangle), "its id, as in the EXR");
  row("material", name_of_material(*model.scene.mesh, pixel.material), "Ctrl + click edits it");
  row("depth", format("%.4g", pixel.depth), "along the view axis, scene units");
  row("position", xyz_text(pixel.position), "x, y, z, scene units");
  row("normal", xyz_text(pixel.normal), "shading normal, unit length");
  ImGui::Separator();
  for (const PixelReport::LightShare& light : pixel.lights)
    row((light.name + (light.reaches ? "" : ": in shadow")).c_str(), rgb_text(light.light),
        "light that it adds to this pixel, linear");
  row("ambient, emitted", rgb_text(pixel.ambient), "light that comes from no lamp");
  row("mirrored", rgb_text(pixel.mirrored), "light from reflected and refracted rays");
  ImGui::Separator();
  draw_cost(model, pixel);
  if (model.pixel_error)
    row("error", format("%.6f", *model.pixel_error),
        "largest difference of a colour from the reference here");
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
  if (list_item("..")) go_to = files.folder.parent_path();
  tooltip("the folder above");
  for (const FolderEntry& entry : files.entries) {
    const std::string name = entry.path.filename().string() + (entry.is_folder ? "/" : "");
    if (list_item(name.c_str())) {
      if (entry.is_folder)
        go_to = entry.path;
      else
        model.file_to_open = entry.path.string();
    }
    tooltip(entry.is_folder                   ? "open this folder"
            : is_environment_file(entry.path) ? "light the scene with this environment"
                                              : "open this scene");
  }
  ImGui::EndChild();
  if (!go_to.empty()) files.go_to(go_to);
  if (model.recent.empty()) return;
  ImGui::TextUnformatted("Recent");
  for (const std::string& file : model.recent) {
    if (list_item(file.c_str())) model.file_to_open = file;
    tooltip("open it again");
  }
}

}  // namespace pinocchio::app
