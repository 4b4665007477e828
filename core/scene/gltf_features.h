// What a glTF file asks for, held against what is read: looked at in its JSON, before anything else.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "pinocchio/load.h"

namespace pinocchio {

// Whether it is glTF 2.0 that requires no extension that is not read; the error names what is in the way.
[[nodiscard]] Expected<void> check_gltf_requirements(const std::filesystem::path& file,
                                                     const nlohmann::json& gltf);

// Adds a warning for every feature of the file that nothing reads. What is known only while it is read (an
// image that is damaged, a camera that cannot look) is warned of where it is read.
void add_lost_gltf_features(const std::filesystem::path& file, const nlohmann::json& gltf,
                            Warnings& warnings);

// The same for every number that names nothing the file has: an accessor, a camera, a scene.
void add_lost_gltf_references(const std::filesystem::path& file, const nlohmann::json& gltf,
                              Warnings& warnings);

}  // namespace pinocchio
