// What of a glTF file is read from its JSON by ourselves: buffers, buffer views, images. Of tinygltf's model
// only the rest is tinygltf's.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/gltf_file.h"

namespace pinocchio {

// Fills file.buffers and the model's bufferViews (unpacking EXT_meshopt_compression) and images (whose files
// are read when they are decoded).
[[nodiscard]] Expected<void> read_gltf_buffers(GltfFile& file, const nlohmann::json& gltf,
                                               std::span<const unsigned char> binary_chunk);

// Unpacks a buffer view of this extension, EXT_meshopt_compression or KHR_meshopt_compression. Of what only
// the latter knows, nothing is read.
[[nodiscard]] Expected<FileBytes> unpack_meshopt(const GltfFile& file, const nlohmann::json& packed,
                                                 const std::string& extension, const std::string& whose);

// Stands before the number of one of GltfFile::data_uris in its place.
inline constexpr std::string_view kDataAside = "data:aside,";

// What KHR_draco_mesh_compression is called where tinygltf does not see it: it would unpack it, without
// buffers.
inline constexpr const char* kDracoAside = "pinocchio_draco";

// Unpacks every primitive of KHR_draco_mesh_compression into accessors of its own.
[[nodiscard]] Expected<void> unpack_draco(GltfFile& file);

// A member that is text; empty where it is something else.
[[nodiscard]] std::string text_member(const nlohmann::json& object, const char* key);

// A member that is a whole number of 0 or more; nothing where it is something else.
[[nodiscard]] std::optional<std::size_t> size_member(const nlohmann::json& object, const char* key);

}  // namespace pinocchio
