#include "core/scene/gltf/format/variants.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/listed.h"
#include "core/scene/gltf/format/json.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr const char* kVariantsExtension = "KHR_materials_variants";

}  // namespace

std::vector<std::string> gltf_variants(const nlohmann::json& gltf) {
  std::vector<std::string> names;
  for (const nlohmann::json& variant : array_member(extension(&gltf, kVariantsExtension), "variants"))
    names.push_back(text_member(&variant, "name"));
  return names;
}

Expected<int> chosen_gltf_variant(const std::filesystem::path& file, const nlohmann::json& gltf,
                                  const std::string& name) {
  if (name.empty()) return -1;
  std::vector<std::string> names = gltf_variants(gltf);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return as_int(found - names.begin());
  for (std::string& other : names) other = "'" + other + "'";
  return Unexpected(InputError{file.string(), 0, "has no variant '" + name + "' of its materials",
                               names.empty() ? "it has none" : "choose from " + listed(names, ", ", " or ")});
}

int material_in_variant(const nlohmann::json& primitive, int variant) {
  if (variant >= 0)
    for (const nlohmann::json& mapping : array_member(extension(&primitive, kVariantsExtension), "mappings"))
      if (const std::vector<int> variants = indices_member(&mapping, "variants");
          std::ranges::find(variants, variant) != variants.end())
        return index_member(&mapping, "material");
  return index_member(&primitive, "material");
}

}  // namespace pinocchio
