#pragma once

#include <memory>

#include "pinocchio/environment.h"

namespace pinocchio {

// The environment as horizontal ground receives it: each direction's light times its cosine to +Y. Its shares
// choose directions so that samples bring the ground the same light each. Kept while the environment is.
[[nodiscard]] std::shared_ptr<const Environment> sky_on_ground(
    const std::shared_ptr<const Environment>& environment);

}  // namespace pinocchio
