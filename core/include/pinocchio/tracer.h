#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "pinocchio/backfaces.h"
#include "pinocchio/build_options.h"
#include "pinocchio/mesh.h"
#include "pinocchio/ray.h"
#include "pinocchio/ray_offset.h"
#include "pinocchio/scene.h"

namespace pinocchio {

struct LaneSteps;
struct MotionState;
struct MaterialMarks;
struct PassedSurfaces;
struct RayColumns;
struct SceneTrees;
struct WideTree;
class ClearWaysToLights;
class SettledUnderLights;
class WideOnDemand;

// The instruction set, which sets the width of ray packets.
// All architectures use the same names: x86-64 has the first four, 64-bit Arm has scalar and neon.
enum class Isa { scalar, sse4, avx2, avx512, neon };

inline constexpr std::array<std::string_view, 5> kIsaNames{"scalar", "sse4", "avx2", "avx512", "neon"};
[[nodiscard]] constexpr std::string_view isa_name(Isa isa) {
  return name_of(kIsaNames, isa);
}
[[nodiscard]] bool isa_supported(Isa isa);        // by this processor
[[nodiscard]] std::vector<Isa> supported_isas();  // narrowest first

// The widest that this processor supports: wider was faster in every measurement (docs/measurements.md).
[[nodiscard]] Isa default_isa();

// A shared mesh and its trees: closest hits and occlusion of any number of rays. Rays need not be coherent;
// neighbours in the span with similar directions are traced as one packet. A ray's hit does not depend, to
// the last bit, on its neighbours or the packet's width. Where triangles are equally far, the one with the
// lowest id is hit. A ray with NaN or infinity in its origin or direction, or with a zero direction, hits
// nothing. May be called from many threads.
class Tracer {
 public:
  // Builds the tree on options.threads threads. The mesh has at least one triangle and finite positions,
  // which load_scene and check_scene ensure. `isa`: none means default_isa(). Throws EnvironmentError if the
  // processor does not support it.
  explicit Tracer(std::shared_ptr<const Mesh> mesh, const BuildOptions& options = {},
                  std::optional<Isa> isa = {}, OffsetMethod offset = OffsetMethod::error_bound);
  // The same for a scene's mesh. `before`: a tracer of another pose of the scene (posed, at_time), with the
  // same options; null: none. Its trees are kept where nodes stand still or moved without changing their
  // shape. Nodes get trees of their own when they move for the second time. No hit depends on it.
  Tracer(const Scene& scene, const BuildOptions& options, std::optional<Isa> isa, OffsetMethod offset,
         const Tracer* before);

  // hits[i]: the closest hit of ray i, t in lengths of the ray's direction. hits.size() == rays.size().
  // `backfaces`: the backs that the rays pass; without, they are stopped by both sides.
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits,
                    Backfaces backfaces = Backfaces::draw) const;
  // blocked[i] is 1 if ray i meets any triangle, else 0. blocked.size() == rays.size().
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

  // For the tile pass, which has its `n` rays in columns (walk/kernels.h). `backs`: the materials whose backs
  // the rays pass. `passed`: the surfaces that may let them pass. Null: there are none.
  void closest_hits(const RayColumns& rays, std::size_t n, std::uint32_t* triangle, float* t = nullptr,
                    const MaterialMarks* backs = nullptr) const;
  void occluded(const RayColumns& rays, std::size_t n, std::uint8_t* blocked,
                const PassedSurfaces* passed = nullptr) const;
  // Null: all shadow rays are to be traced.
  [[nodiscard]] ClearWaysToLights* clear_ways() const { return clear_ways_.get(); }
  // Null where clear_ways() is.
  [[nodiscard]] SettledUnderLights* settled() const { return settled_.get(); }
  // The steps of the tile pass at this tracer's width.
  [[nodiscard]] const LaneSteps& steps() const;

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] const SceneTrees& trees() const { return *trees_; }
  [[nodiscard]] Isa isa() const { return isa_; }
  // How rays that start on its surfaces keep off them.
  [[nodiscard]] const RayOffset& offset() const { return offset_; }
  // When its trees were built, seconds of the steady clock.
  [[nodiscard]] double build_begin_s() const { return build_begin_s_; }
  [[nodiscard]] double build_end_s() const { return build_end_s_; }

 private:
  // Null: packets are faster for these rays, or there have been few incoherent ones so far.
  [[nodiscard]] const WideTree* wide_tree_for(const RayColumns& rays, std::size_t n) const;

  double build_begin_s_, build_end_s_ = 0.0;
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<const MotionState> motion_;  // for the next pose's tracer; null: the scene has no nodes
  std::shared_ptr<const SceneTrees> trees_;
  std::shared_ptr<WideOnDemand> wide_;             // null: the trees have none
  std::shared_ptr<ClearWaysToLights> clear_ways_;  // likewise
  std::shared_ptr<SettledUnderLights> settled_;    // likewise
  Isa isa_;
  RayOffset offset_;
};

}  // namespace pinocchio
