#include "core/scene/pose/shared_meshes.h"

namespace pinocchio {
namespace {

// The triangles that copies must spare a scene in all, and those that a mesh must have: measured.
constexpr double kLeastSpared = 131072.0;
constexpr double kLeastTriangles = 32.0;

}  // namespace

std::vector<bool> share_trees(std::span<const MeshPlacings> meshes) {
  std::vector<bool> share;
  double spared = 0.0;
  for (const MeshPlacings& mesh : meshes) {
    share.push_back(mesh.placings > 1.0 && mesh.triangles >= kLeastTriangles);
    if (share.back()) spared += (mesh.placings - 1.0) * mesh.triangles;
  }
  if (spared < kLeastSpared) share.assign(share.size(), false);
  return share;
}

}  // namespace pinocchio
