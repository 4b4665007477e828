// Scenes from arrays.
#pragma once

#include "python/src/scene/scene.h"

namespace pinocchio::python {

// The scene without lights. Throws Error.
[[nodiscard]] Scene scene_of(const Floats3& vertices, const Words3& triangles,
                             const std::optional<Floats3>& normals, const std::optional<Floats2>& uvs,
                             const std::optional<Floats3>& colors,
                             const std::vector<TexturedMaterial>& materials,
                             const std::optional<Words>& triangle_materials, const Three& ambient);

}  // namespace pinocchio::python
