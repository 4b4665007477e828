#include "bench/rays/sides/our_side.h"

#include <array>

#include "bench/rays/sides/measure.h"
#include "core/bsp/scene_trees.h"
#include "core/bsp/wide/build_wide.h"
#include "core/bsp/wide/wide_on_demand.h"
#include "core/trace/rays/ray_queue.h"

namespace pinocchio::bench {
namespace {

// Rays in columns, as in the tile pass.
class Ours final : public RayBackend {
 public:
  explicit Ours(const Tracer& tracer) : tracer_(tracer) {}

  [[nodiscard]] std::string name() const override { return "ours " + std::string(isa_name(tracer_.isa())); }

  void load(const RaySet& set) override {
    query_ = set.query;
    count_ = set.rays.size();
    const std::size_t room = (count_ / kChunk + 1) * kChunk + kQueuePad;
    for (AlignedVector<float>& column : columns_) column.resize(room);
    triangle_.assign(room, kNoTriangle);
    t_.assign(room, 0.0f);
    blocked_.assign(room, 0);
    for (std::size_t i = 0; i < count_; ++i) {
      const Ray& ray = set.rays[i];
      for (int axis = 0; axis < 3; ++axis) {
        columns_[static_cast<std::size_t>(axis)][i] = ray.origin[axis];
        columns_[static_cast<std::size_t>(3 + axis)][i] = ray.direction[axis];
      }
      columns_[6][i] = ray.t_max;
    }
  }

  void trace(std::size_t first, std::size_t count) override {
    const auto column = [&](std::size_t i) { return columns_[i].data() + first; };
    const RayColumns rays{{column(0), column(1), column(2)}, {column(3), column(4), column(5)}, column(6)};
    if (query_ == Query::closest)
      tracer_.closest_hits(rays, count, triangle_.data() + first, t_.data() + first);
    else
      tracer_.occluded(rays, count, blocked_.data() + first);
  }

  [[nodiscard]] std::vector<Hit> hits() const override {
    std::vector<Hit> found(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      if (query_ == Query::closest && triangle_[i] != kNoTriangle) found[i] = {t_[i], triangle_[i]};
      if (query_ == Query::any && blocked_[i]) found[i] = {0.0f, 0};
    }
    return found;
  }

 private:
  const Tracer& tracer_;
  Query query_ = Query::closest;
  std::size_t count_ = 0;
  std::array<AlignedVector<float>, 7> columns_;
  AlignedVector<std::uint32_t> triangle_;
  AlignedVector<float> t_;
  std::vector<std::uint8_t> blocked_;
};

// The vectors' capacity, not only their size.
template <class Vector>
std::size_t held(const Vector& v) {
  return v.capacity() * sizeof(typename Vector::value_type);
}

}  // namespace

std::unique_ptr<Tracer> build_ours(const std::shared_ptr<const Mesh>& mesh, const BuildOptions& options,
                                   Isa isa, int repeat, BuildCost& cost) {
  std::unique_ptr<Tracer> tracer;
  cost.name = "ours";
  cost.seconds = median_seconds(
      repeat, [&] { tracer.reset(); }, [&] { tracer = std::make_unique<Tracer>(mesh, options, isa); });
  const BspTree& tree = *tracer->trees().still;
  cost.bytes = held(tree.nodes) + held(tree.references) + held(tree.triangles) + held(tree.corner_triangles);
  return tracer;
}

BuildCost cost_of_wide_tree(const Tracer& tracer, int threads, int repeat) {
  BuildCost cost{.name = "wide"};
  if (!WideOnDemand::serves(tracer.trees(), tracer.isa())) return cost;
  WideTree tree;
  cost.seconds = median_seconds(
      repeat, [&] { tree = {}; }, [&] { tree = build_wide_tree(tracer.trees(), threads); });
  cost.bytes = held(tree.nodes) + held(tree.leaves);
  return cost;
}

std::unique_ptr<RayBackend> our_backend(const Tracer& tracer) {
  return std::make_unique<Ours>(tracer);
}

}  // namespace pinocchio::bench
