#pragma once

#include <memory>
#include <span>

#include "bench/rays/sides/ray_backend.h"
#include "pinocchio/mesh.h"
#include "pinocchio/tracer.h"

namespace pinocchio::bench {

// An Embree scene, built at high quality on `threads` threads.
class EmbreeSide {
 public:
  // `robust`: uses Embree's watertight triangle test, which is slower than the default. Builds `repeat` times
  // and keeps the last. `widest`: the widest lanes of Embree. Throws EnvironmentError if Embree fails.
  EmbreeSide(const Mesh& mesh, bool robust, int threads, int repeat, Isa widest);
  ~EmbreeSide();
  EmbreeSide(const EmbreeSide&) = delete;
  EmbreeSide& operator=(const EmbreeSide&) = delete;

  [[nodiscard]] const BuildCost& cost() const { return cost_; }

  // Backends for this scene, which must outlive them: single rays, and packets with the coherent flag, of 16
  // rays, or of 8 without AVX-512.
  [[nodiscard]] std::unique_ptr<RayBackend> single() const;
  [[nodiscard]] std::unique_ptr<RayBackend> packets() const;

  // Traces coherent packets of 16: blocked[i] is 1 if ray i meets a triangle, else 0. Called on many threads.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

 private:
  struct Held;
  std::unique_ptr<Held> held_;
  BuildCost cost_;
  bool has_avx512_;
};

// The Embree version that this program was compiled for.
[[nodiscard]] const char* embree_version();

}  // namespace pinocchio::bench
