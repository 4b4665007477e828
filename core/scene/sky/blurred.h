#pragma once

#include <memory>

#include "pinocchio/environment.h"

namespace pinocchio {

// The environment's light, spread in all directions by a bell curve with that standard deviation; 0: the
// environment itself. The last pictures are kept while the environment lives. Any thread.
[[nodiscard]] std::shared_ptr<const Environment> blurred(
    const std::shared_ptr<const Environment>& environment, float deviation_deg);

}  // namespace pinocchio
