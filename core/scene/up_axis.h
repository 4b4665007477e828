#pragma once

#include "pinocchio/error.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// The scene of a file whose Z points up, turned so that Y does. A scene with nodes gets one above them, which
// turns them.
[[nodiscard]] Expected<Scene> turned_up(Scene scene);

}  // namespace pinocchio
