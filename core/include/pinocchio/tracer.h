#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "pinocchio/build_options.h"
#include "pinocchio/mesh.h"
#include "pinocchio/ray.h"
#include "pinocchio/ray_offset.h"

namespace pinocchio {

struct BspTree;
struct LaneSteps;
struct RayColumns;

// Width of the packets that rays are traced in.
enum class Isa { scalar, sse4, avx2, avx512 };

inline constexpr std::array<std::string_view, 4> kIsaNames{"scalar", "sse4", "avx2", "avx512"};
[[nodiscard]] constexpr std::string_view isa_name(Isa isa) {
  return name_of(kIsaNames, isa);
}
[[nodiscard]] bool isa_supported(Isa isa);        // by this processor
[[nodiscard]] std::vector<Isa> supported_isas();  // narrowest first

// The widest that this processor has: wider was faster wherever it was measured (docs/measurements.md).
[[nodiscard]] Isa default_isa();

// A mesh, which it shares, and its tree: closest hits and occlusion of any number of rays, which need not
// belong together; neighbours in the span that go the same way are traced as one packet. What a ray hits does
// not depend on its neighbours nor on the packet's width, to the last bit. Of triangles at one distance
// the lowest id is hit. A ray whose origin or direction is NaN or infinite, or whose direction is zero,
// hits nothing. Safe to call from many threads.
class Tracer {
 public:
  // Builds the tree, on options.threads threads. The mesh has at least one triangle and finite positions, as
  // load_scene and check_scene see to. `isa`: nothing asks for default_isa(); one that the processor lacks
  // throws EnvironmentError.
  explicit Tracer(std::shared_ptr<const Mesh> mesh, const BuildOptions& options = {},
                  std::optional<Isa> isa = {}, OffsetMethod offset = OffsetMethod::error_bound);

  // hits[i] is the closest of ray i, its t in lengths of the ray's direction; hits.size() == rays.size().
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const;
  // blocked[i] = 1 where any triangle lies within ray i, else 0; blocked.size() == rays.size().
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

  // The same of `n` rays in columns, as trace/kernels.h has it: what the tile pass uses.
  void closest_hits(const RayColumns& rays, std::size_t n, std::uint32_t* triangle, float* t = nullptr) const;
  void occluded(const RayColumns& rays, std::size_t n, std::uint8_t* blocked) const;
  // Steps of the tile pass at this tracer's width.
  [[nodiscard]] const LaneSteps& steps() const;

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] const BspTree& tree() const { return *tree_; }
  [[nodiscard]] Isa isa() const { return isa_; }
  // Of the rays that start on its surfaces: what surface_at wants.
  [[nodiscard]] const RayOffset& offset() const { return offset_; }

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<const BspTree> tree_;
  Isa isa_;
  RayOffset offset_;
};

}  // namespace pinocchio
