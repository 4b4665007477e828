#include "bench/our_side.h"

#include <algorithm>
#include <span>

#include "bench/measure.h"

namespace pinocchio::bench {
namespace {

class Ours final : public Contender {
 public:
  explicit Ours(const Tracer& tracer) : tracer_(tracer) {}

  [[nodiscard]] std::string name() const override { return "ours " + std::string(isa_name(tracer_.isa())); }

  void load(const RaySet& set) override {
    query_ = set.query;
    rays_ = set.rays;
    hits_.assign(query_ == Query::closest ? rays_.size() : 0, Hit{});
    blocked_.assign(query_ == Query::any ? rays_.size() : 0, 0);
  }

  void trace(std::size_t first, std::size_t count) override {
    const std::span<const Ray> rays = std::span(rays_).subspan(first, count);
    if (query_ == Query::closest)
      tracer_.closest_hits(rays, std::span(hits_).subspan(first, count));
    else
      tracer_.occluded(rays, std::span(blocked_).subspan(first, count));
  }

  [[nodiscard]] std::vector<Hit> hits() const override {
    if (query_ == Query::closest) return hits_;
    std::vector<Hit> found(blocked_.size());
    for (std::size_t i = 0; i < blocked_.size(); ++i)
      if (blocked_[i]) found[i] = {0.0f, 0};
    return found;
  }

 private:
  const Tracer& tracer_;
  Query query_ = Query::closest;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<std::uint8_t> blocked_;
};

// What the vectors hold on to, not only what they use.
template <class Vector>
std::size_t held(const Vector& v) {
  return v.capacity() * sizeof(typename Vector::value_type);
}

}  // namespace

std::unique_ptr<Tracer> build_ours(const Scene& scene, const BuildOptions& options, Isa isa, int repeat,
                                   BuildCost& cost) {
  std::unique_ptr<Tracer> tracer;
  cost.name = "ours";
  cost.seconds = median_seconds(
      repeat, [&] { tracer.reset(); }, [&] { tracer = std::make_unique<Tracer>(scene, options, isa); });
  const BspTree& tree = tracer->tree();
  cost.bytes = held(tree.nodes) + held(tree.references) + held(tree.triangles) + held(tree.corner_triangles);
  return tracer;
}

std::unique_ptr<Contender> our_contender(const Tracer& tracer) {
  return std::make_unique<Ours>(tracer);
}

}  // namespace pinocchio::bench
