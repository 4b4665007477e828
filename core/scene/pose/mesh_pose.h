// Which pose a mesh is in, and the meshes of earlier poses that new ones are made of.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/parallel/workers.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// Where a node's vertices are.
struct NodePlace {
  std::uint32_t first_vertex = 0, vertices = 0, first_triangle = 0, triangles = 0;  // the node's
  std::uint64_t number = 0;  // of the placing, no two are equal; 0: as in the first mesh
  bool rigid = false;        // placed by `world` alone
  bool whole = false;        // its triangles have all of its vertices
  glm::mat4 world{0.0f};
  Bounds bounds;  // of its triangles

  // Whether the vertices are the same to the last bit.
  [[nodiscard]] bool same_as(const NodePlace& other) const {
    return number == other.number ||
           (rigid && other.rigid && std::memcmp(&world, &other.world, sizeof(world)) == 0);
  }
};

struct MeshPose {
  std::weak_ptr<const Mesh> first;    // the mesh that was posed, before any of its poses
  std::vector<NodePlace> nodes;       // one for each node
  Bounds others;                      // of the triangles that no node has
  double begin_s = 0.0, end_s = 0.0;  // when it was made; 0: at no time that counts

  // Whether both are poses of one mesh.
  [[nodiscard]] bool is_of_same_mesh(const MeshPose& other) const {
    return !first.owner_before(other.first) && !other.first.owner_before(first);
  }
  // The nodes that are not where they are in another pose of the mesh. It has as many.
  [[nodiscard]] std::vector<const NodePlace*> moved_since(const MeshPose& other) const;
  [[nodiscard]] Bounds bounds() const;
};

// The poses of one scene: any thread.
class PosePool : public std::enable_shared_from_this<PosePool> {
 public:
  // The pose of the scene's mesh. Null: its nodes share vertices, so that no node moves alone.
  [[nodiscard]] std::shared_ptr<const MeshPose> pose_of(const Scene& scene);

  // A mesh like the scene's, in which the vertices of the nodes of `placed` are undefined.
  [[nodiscard]] std::unique_ptr<Mesh> like(const Scene& scene, const MeshPose& pose,
                                           const std::vector<bool>& placed);
  // Sets what belongs to the pose. The mesh comes back here when nobody holds it any more.
  [[nodiscard]] std::shared_ptr<const Mesh> finish(std::unique_ptr<Mesh> mesh,
                                                   std::shared_ptr<const MeshPose> pose);

  [[nodiscard]] static std::uint64_t next_number();

  // Calls body(i) for all of [0, n): on several threads, which are kept, where that many vertices are worth
  // it.
  void for_each(std::size_t n, std::size_t vertices, const std::function<void(std::size_t)>& body);

 private:
  void put_back(std::unique_ptr<Mesh> mesh);
  [[nodiscard]] std::unique_ptr<Mesh> pop(const MeshPose& pose);

  std::mutex mutex_;
  std::optional<Workers> workers_;
  std::shared_ptr<const MeshPose> first_;    // of the last mesh that was posed first
  std::vector<std::unique_ptr<Mesh>> left_;  // the poses that nobody holds, oldest first
};

// The bounds of a node's triangles in another mesh.
[[nodiscard]] Bounds bounds_of(const NodePlace& node, const MeshData& mesh);

}  // namespace pinocchio
