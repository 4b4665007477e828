// The steps of read_gltf_file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/gltf/file.h"

namespace pinocchio {

// An error about a part of the file's JSON, whose JSON pointer it names.
[[nodiscard]] Unexpected malformed(const GltfFile& file, const nlohmann::json& json, const std::string& what);

// Whether all items of the file's arrays are objects.
[[nodiscard]] Expected<void> check_gltf_objects(const GltfFile& file);

// Fills buffers, buffer views (unpacking EXT_meshopt_compression) and images (whose files are read when they
// are decoded).
[[nodiscard]] Expected<void> read_gltf_buffers(GltfFile& file, std::span<const unsigned char> binary_chunk);

// Fills accessors, meshes, nodes and skins.
[[nodiscard]] Expected<void> read_gltf_lists(GltfFile& file);

// Unpacks a buffer view of this extension, EXT_meshopt_compression or KHR_meshopt_compression. What only the
// latter defines is an error.
[[nodiscard]] Expected<FileBytes> unpack_meshopt(const GltfFile& file, const nlohmann::json& packed,
                                                 const std::string& extension, const std::string& whose);

// Unpacks every primitive of KHR_draco_mesh_compression into accessors of its own.
[[nodiscard]] Expected<void> unpack_draco(GltfFile& file);

// Stands with an index of GltfFile::data_uris in a long data URI's place.
inline constexpr std::string_view kDataAside = "data:aside,";

}  // namespace pinocchio
