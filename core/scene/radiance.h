#pragma once

#include <span>
#include <string>

#include "core/scene/memory_limit.h"
#include "pinocchio/image.h"

namespace pinocchio {

// A Radiance picture (.hdr, RGBE), linear; errors name `file`.
[[nodiscard]] Expected<Image<glm::vec3>> decode_radiance(const std::string& file,
                                                         std::span<const unsigned char> bytes,
                                                         MemoryLimit& limit);

}  // namespace pinocchio
