// KHR_materials_variants: several materials for a primitive, of which a named variant chooses one.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "pinocchio/error.h"

namespace pinocchio {

// Their names, in the file's order.
[[nodiscard]] std::vector<std::string> gltf_variants(const nlohmann::json& gltf);

// The number of the variant with that name; -1: `name` is empty. Error: the file has no such variant.
[[nodiscard]] Expected<int> chosen_gltf_variant(const std::filesystem::path& file, const nlohmann::json& gltf,
                                                const std::string& name);

// The index of the primitive's material; -1: it has none. `variant`: -1 for the primitive's own.
[[nodiscard]] int material_in_variant(const nlohmann::json& primitive, int variant);

}  // namespace pinocchio
