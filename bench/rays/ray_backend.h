#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/rays/ray_sets.h"
#include "pinocchio/ray.h"

namespace pinocchio::bench {

// Rays that a thread takes at a time, the same for everyone: as many as a tile of the picture has.
inline constexpr std::size_t kChunk = 1024;

// One way to trace a set of rays.
class RayBackend {
 public:
  RayBackend() = default;
  RayBackend(const RayBackend&) = delete;
  RayBackend& operator=(const RayBackend&) = delete;
  virtual ~RayBackend() = default;

  [[nodiscard]] virtual std::string name() const = 0;

  // Brings the rays into the backend's own layout; before every repetition, not timed.
  virtual void load(const RaySet& set) = 0;

  // Traces the loaded rays [first, first + count); first is a multiple of kChunk. Called by many threads.
  virtual void trace(std::size_t first, std::size_t count) = 0;

  // What was found, one a ray; of Query::any: t = 0 and triangle 0 where something was in the way.
  [[nodiscard]] virtual std::vector<Hit> hits() const = 0;
};

// What it costs to be able to trace a scene.
struct BuildCost {
  std::string name;
  double seconds = 0.0;
  std::size_t bytes = 0;  // kept while rays are traced, the scene's own vertices and indices aside
};

}  // namespace pinocchio::bench
