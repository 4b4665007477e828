// Refuses GLM_FORCE_DEFAULT_ALIGNED_GENTYPES, GLM_FORCE_ALIGNED_GENTYPES and GLM_FORCE_QUAT_DATA_WXYZ in the
// caller: they would silently give every structure another layout than the library's.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace pinocchio {

#define PINOCCHIO_GLM_IS(type, scalar, count)                                                           \
  static_assert(sizeof(glm::type) == (count) * sizeof(scalar) && alignof(glm::type) == alignof(scalar), \
                "glm::" #type                                                                           \
                " has another layout than in the library; leave out GLM_FORCE_*ALIGNED_GENTYPES")
PINOCCHIO_GLM_IS(vec2, float, 2);
PINOCCHIO_GLM_IS(vec3, float, 3);
PINOCCHIO_GLM_IS(vec4, float, 4);
PINOCCHIO_GLM_IS(ivec2, int, 2);
PINOCCHIO_GLM_IS(uvec3, unsigned, 3);
PINOCCHIO_GLM_IS(u8vec3, unsigned char, 3);
PINOCCHIO_GLM_IS(u8vec4, unsigned char, 4);
PINOCCHIO_GLM_IS(mat3, float, 9);
PINOCCHIO_GLM_IS(mat4, float, 16);
PINOCCHIO_GLM_IS(mat3x2, float, 6);
PINOCCHIO_GLM_IS(dquat, double, 4);
#undef PINOCCHIO_GLM_IS

#ifdef GLM_FORCE_QUAT_DATA_WXYZ
#error "the library is compiled without GLM_FORCE_QUAT_DATA_WXYZ; leave it out"
#endif

}  // namespace pinocchio
