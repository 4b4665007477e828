#include "core/scene/gltf/format/material_table.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/scene/gltf/format/json.h"

namespace pinocchio {
namespace {

// Returns the one that has class C's members: the material, the surface, or the surface's layers.
template <class C, class M, class S>
auto& owner_of(M& material, S& surface) {
  if constexpr (std::is_same_v<C, Material>)
    return material;
  else if constexpr (std::is_same_v<C, GltfLayers>)
    return surface.layers;
  else
    return surface;
}

}  // namespace

std::string_view gltf_extension_of(std::string_view at) {
  constexpr std::string_view kWithin = "/extensions/";
  if (!at.starts_with(kWithin)) return {};
  at.remove_prefix(kWithin.size());
  return at.substr(0, at.find('/'));
}

bool is_in_material_table(std::string_view extension) {
  const auto has = [&](const auto& table) {
    return std::ranges::any_of(table,
                               [&](const auto& row) { return gltf_extension_of(row.at) == extension; });
  };
  return has(kSurfaceParameters) || has(kVolumeParameters) || has(kGltfTextures);
}

GltfValue read_gltf_parameter(const nlohmann::json& json, const GltfParameter& row, Material& material,
                              GltfSurface& surface) {
  const nlohmann::json* const given = find_at(&json, row.at);
  if (!given) return GltfValue::fits;
  return std::visit(
      [&]<class T, class C>(T C::*member) {
        const std::optional<T> value = value_of<T>(*given);
        if (!value) return GltfValue::wrong_type;
        T& to = owner_of<C>(material, surface).*member;
        if constexpr (std::is_same_v<T, bool>)
          to = *value;
        else
          to = glm::clamp(*value, T(row.range.least), T(row.range.most));
        return to == *value ? GltfValue::fits : GltfValue::clamped;
      },
      row.member);
}

void write_gltf_parameter(const GltfParameter& row, const Material& material, const GltfSurface& surface,
                          const Material& usual, nlohmann::ordered_json& json) {
  const GltfSurface usual_surface;
  std::visit(
      [&]<class T, class C>(T C::*member) {
        const T& value = owner_of<C>(material, surface).*member;
        if (value == owner_of<C>(usual, usual_surface).*member) return;
        nlohmann::ordered_json& to = json[nlohmann::ordered_json::json_pointer(row.at)];
        if constexpr (std::is_same_v<T, glm::vec3>)
          to = gltf_extension_of(row.at).empty() ? color_json(value) : vec3_json(value);
        else
          to = value;
      },
      row.member);
}

nlohmann::ordered_json vec3_json(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

nlohmann::ordered_json color_json(const glm::vec3& v) {
  return v.x == v.y && v.y == v.z ? nlohmann::ordered_json(v.x) : vec3_json(v);
}

}  // namespace pinocchio
