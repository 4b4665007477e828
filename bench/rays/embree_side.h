#pragma once

#include <memory>
#include <span>

#include "bench/rays/ray_backend.h"
#include "pinocchio/mesh.h"
#include "pinocchio/tracer.h"

namespace pinocchio::bench {

// A scene as Embree holds it: built at high quality on all of `threads`.
class EmbreeSide {
 public:
  // `robust`: Embree's watertight triangle test, slower; by default its fast one. Builds `repeat` times
  // and keeps the last. `widest`: Embree uses no wider lanes. Throws EnvironmentError where Embree fails.
  EmbreeSide(const Mesh& mesh, bool robust, int threads, int repeat, Isa widest);
  ~EmbreeSide();
  EmbreeSide(const EmbreeSide&) = delete;
  EmbreeSide& operator=(const EmbreeSide&) = delete;

  [[nodiscard]] const BuildCost& cost() const { return cost_; }

  // Backends over this scene, which must outlive them: rays one by one, and packets with the
  // coherent flag: of 16, of 8 where it has no AVX-512.
  [[nodiscard]] std::unique_ptr<RayBackend> single() const;
  [[nodiscard]] std::unique_ptr<RayBackend> packets() const;

  // Coherent packets of 16; blocked[i] = 1 where anything lies within ray i, else 0. Called by many threads.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

 private:
  struct Held;
  std::unique_ptr<Held> held_;
  BuildCost cost_;
  bool has_avx512_;
};

// The version of Embree that this was compiled for.
[[nodiscard]] const char* embree_version();

}  // namespace pinocchio::bench
