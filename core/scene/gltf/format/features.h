// Features of a glTF file that are not read. Its JSON is checked before anything else is.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/files/loading.h"

namespace pinocchio {

// An error where the file is not glTF 2.0 or requires an extension that is not read.
[[nodiscard]] Expected<void> check_gltf_requirements(const std::filesystem::path& file,
                                                     const nlohmann::json& gltf);

// Adds a warning for every feature of the file that is not read. Its readers warn of what only they know: a
// damaged image, a camera without a field of view.
// `variant`: of the materials, -1 where none is chosen.
void add_lost_gltf_features(const std::filesystem::path& file, const nlohmann::json& gltf, int variant,
                            Loading& loading);

// The same for every index that names nothing: an accessor, a camera, a scene.
void add_lost_gltf_references(const std::filesystem::path& file, const nlohmann::json& gltf,
                              Warnings& warnings);

}  // namespace pinocchio
