#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "pinocchio/tracer.h"

namespace pinocchio {

// The material whose inside a point lies in, of bodies that absorb light, or kNoMedium. Five rays leave the
// point and count how often each body's surface is met from behind and from in front: where the point is
// inside, from behind one time more. The first such body along the ray is the innermost. At least three rays
// have to agree, so that one that grazes an edge does not decide. Bodies must be closed, with fronts outside.
[[nodiscard]] std::uint32_t medium_at(const Tracer& tracer, const glm::vec3& p_world);

// The same for the camera's rays, where they have one eye and some material absorbs light; else kNoMedium.
[[nodiscard]] std::uint32_t medium_of_eye(const Tracer& tracer, const glm::vec3& eye, bool has_one_eye);

}  // namespace pinocchio
