#include "pinocchio/tracer.h"

#include <array>
#include <cassert>
#include <string>
#include <utility>

#include "core/bsp/build.h"
#include "core/trace/kernels.h"
#include "pinocchio/error.h"

namespace pinocchio {
namespace {

// In Isa's order, narrowest first.
const std::array<const Kernels*, kIsaNames.size()> kKernels{&scalar::kKernels, &sse4::kKernels,
                                                            &avx2::kKernels, &avx512::kKernels};

const Kernel& kernel_of(Isa isa, TriangleTest test) {
  return (*kKernels[static_cast<std::size_t>(isa)])[static_cast<std::size_t>(test)];
}

Isa choose(std::optional<Isa> wanted) {
  if (!wanted) return default_isa();
  if (!isa_supported(*wanted))
    throw EnvironmentError("--isa " + std::string(isa_name(*wanted)) + ": this processor does not have it");
  return *wanted;
}

}  // namespace

bool isa_supported(Isa isa) {
  switch (isa) {
    case Isa::scalar:
      return true;
    case Isa::sse4:
      return __builtin_cpu_supports("sse4.1");
    case Isa::avx2:
      return __builtin_cpu_supports("avx2");
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f");
  }
  return false;
}

std::vector<Isa> supported_isas() {
  std::vector<Isa> found;
  for (const Isa isa : {Isa::scalar, Isa::sse4, Isa::avx2, Isa::avx512})
    if (isa_supported(isa)) found.push_back(isa);
  return found;
}

Isa default_isa() {
  return supported_isas().back();
}

Tracer::Tracer(std::shared_ptr<const Mesh> mesh, const BuildOptions& options, std::optional<Isa> isa,
               OffsetMethod offset)
    : mesh_(std::move(mesh)),
      tree_(std::make_shared<const BspTree>(build_tree(*mesh_, options))),
      isa_(choose(isa)),
      offset_(RayOffset::of(offset, tree_->bounds)) {}

void Tracer::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
  assert(rays.size() == hits.size());
  kernel_of(isa_, tree_->test).closest_hits(*tree_, rays.data(), hits.data(), rays.size());
}

void Tracer::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  assert(rays.size() == blocked.size());
  kernel_of(isa_, tree_->test).occluded(*tree_, rays.data(), blocked.data(), rays.size());
}

}  // namespace pinocchio
