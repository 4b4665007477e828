#pragma once

#include "core/scene/formats.h"
#include "core/scene/obj/text.h"

namespace pinocchio {

// Appends the faces of an OBJ as triangles. `materials`: indices of the mesh's materials, one for each
// name of obj.materials; faces before the first name have material 0. Phase "mesh".
void add_obj_faces(const ObjText& obj, const std::vector<std::uint32_t>& materials,
                   const std::filesystem::path& file, Loading& loading, MeshData& mesh);
// Appends its points and lines as balls and tubes.
[[nodiscard]] Expected<void> add_obj_strokes(const ObjText& obj, const std::vector<std::uint32_t>& materials,
                                             const std::filesystem::path& file, Loading& loading,
                                             MeshData& mesh);

}  // namespace pinocchio
