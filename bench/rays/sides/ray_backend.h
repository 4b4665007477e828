#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/rays/sides/ray_sets.h"
#include "pinocchio/ray.h"

namespace pinocchio::bench {

// The rays that a thread traces at a time, for all backends: as many as a tile of the picture has.
inline constexpr std::size_t kChunk = 1024;

// A way to trace a set of rays.
class RayBackend {
 public:
  RayBackend() = default;
  RayBackend(const RayBackend&) = delete;
  RayBackend& operator=(const RayBackend&) = delete;
  virtual ~RayBackend() = default;

  [[nodiscard]] virtual std::string name() const = 0;

  // Converts the rays to the backend's layout. Called before each repetition, not timed.
  virtual void load(const RaySet& set) = 0;

  // Traces the loaded rays [first, first + count); first is a multiple of kChunk. Called on many threads.
  virtual void trace(std::size_t first, std::size_t count) = 0;

  // The hits, one for each ray. For Query::any: t = 0 and triangle 0 if the ray is blocked.
  [[nodiscard]] virtual std::vector<Hit> hits() const = 0;
};

// The cost of preparing a scene for tracing.
struct BuildCost {
  std::string name;
  double seconds = 0.0;
  std::size_t bytes = 0;  // during tracing, without the scene's vertices and indices
};

}  // namespace pinocchio::bench
