// The panel Materials: an edit is left in model.material_edit.
#include <algorithm>
#include <string>
#include <utility>

#include "app/window/overlay/parts.h"
#include "core/scene/gltf/material_from_surface.h"

namespace pinocchio::app {
namespace {

bool slide(const char* name, float& value, float lo, float hi, const std::string& help) {
  return slider(name, value, lo, hi, format("%.2f", value), help);
}

// A control for each parameter, named as glTF and the programs that write it do. True: one was moved.
bool edit_surface(GltfSurface& s, bool textured) {
  const std::string times = textured ? "; multiplies the texture's" : "";
  bool changed = edit_color("base colour", s.base_color, "colour of the surface" + times);
  s.base_color = glm::min(s.base_color, glm::vec3(1.0f));
  changed =
      slide("metallic", s.metallic, 0.0f, 1.0f, "1: a metal, 0: plastic, wood, cloth" + times) || changed;
  changed = slide("roughness", s.roughness, 0.0f, 1.0f, "0: a mirror, 1: matt" + times) || changed;
  changed = edit_color("emitted", s.emissive, "light that the surface emits" + times) || changed;
  changed = slide("transmission", s.transmission, 0.0f, 1.0f, "1: glass" + times) || changed;
  changed = slide("index", s.ior, 1.0f, 3.0f, "index of refraction; 1.5 for glass and plastic") || changed;
  changed = slide("clear coat", s.layers.coat, 0.0f, 1.0f, "a layer of varnish" + times) || changed;
  if (s.layers.coat > 0.0f)
    changed =
        slide("its roughness", s.layers.coat_roughness, 0.0f, 1.0f, "of the clear coat" + times) || changed;
  return changed;
}

// Phong's parameters, of files that give them.
bool edit_phong(Material& m) {
  bool changed = edit_color("diffuse", m.diffuse, "kd: diffusely reflected light");
  if (changed) m.ambient = m.diffuse;
  changed = edit_color("specular", m.specular, "ks: the highlight's colour") || changed;
  changed = slider("shininess", m.shininess, 1.0f, 256.0f, format("%.0f", m.shininess),
                   "exponent of the highlight: higher is smaller and sharper") ||
            changed;
  changed = edit_color("mirror", m.reflectance, "weight of a mirrored ray; black: no mirror") || changed;
  changed = slide("index", m.ior, 1.0f, 3.0f, "index of refraction, for transparent materials") || changed;
  return changed;
}

void edit(Model& model, const Mesh& mesh) {
  MaterialEdit edited{.material = mesh.materials[model.material]};
  Material& m = edited.material;
  const MaterialMaps* const maps = m.maps >= 0 ? &mesh.maps[m.maps] : nullptr;
  bool changed = false;
  if (m.is_microfacet()) {
    const bool of_maps = maps && maps->from_gltf;
    GltfSurface surface = of_maps ? maps->surface : surface_of_material(m);
    changed = edit_surface(surface, maps != nullptr);
    if (changed) {
      m = with_surface(mesh, m, surface);
      if (of_maps) edited.surface = surface;
    }
  } else {
    changed = edit_phong(m);
  }
  bool double_sided = m.double_sided.value_or(true);
  if (checkbox("double-sided", double_sided,
               "off: the camera sees through the surface from behind, unless backfaces is draw")) {
    m.double_sided = double_sided;
    changed = true;
  }
  if (changed) model.material_edit = std::move(edited);
}

// The file is read again.
void choose_variant(Model& model) {
  const std::vector<std::string>& variants = model.scene.variants;
  if (variants.empty()) return;
  const auto shown = [](const std::string& name) {
    return name.empty() ? std::string("the file's usual one") : name;
  };
  const std::string help = "which of the file's variants of its materials is shown";
  label("variant", help);
  if (ImGui::BeginCombo("##variant", shown(model.variant).c_str())) {
    const auto line = [&](const std::string& name) {
      if (list_item(shown(name).c_str(), name == model.variant) && name != model.variant)
        model.variant_to_use = name;
    };
    line({});
    for (const std::string& name : variants) line(name);
    ImGui::EndCombo();
  }
  tooltip(help);
}

}  // namespace

void draw_materials(Model& model, float scale) {
  if (!model.has_scene()) return paragraph("no scene");
  const Mesh& mesh = *model.scene.mesh;
  choose_variant(model);
  model.material = std::clamp(model.material, 0, int(mesh.materials.size()) - 1);
  ImGui::BeginChild("list", ImVec2(0.0f, 6.0f * ImGui::GetTextLineHeightWithSpacing()), true);
  for (int i = 0; i < std::ssize(mesh.materials); ++i) {
    ImGui::PushID(i);
    if (list_item(name_of_material(mesh, i).c_str(), model.material == i)) model.material = i;
    ImGui::PopID();
    tooltip("edit this material; Ctrl + click in the picture picks one");
    if (i == model.material && std::exchange(model.material_picked, false)) ImGui::SetScrollHereY();
  }
  ImGui::EndChild();
  if (model.material < 0) return;
  ImGui::Dummy(ImVec2(0.0f, 2.0f * scale));
  edit(model, mesh);
}

}  // namespace pinocchio::app
