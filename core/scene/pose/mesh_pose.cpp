#include "core/scene/pose/mesh_pose.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// More are not needed where frames overlap: each frame that is finished gives one back.
constexpr std::size_t kMostLeft = 2;

Bounds bounds_of(const MeshData& mesh, std::size_t first, std::size_t last) {
  Bounds bounds;
  for (std::size_t t = first; t < last; ++t)
    for (int c = 0; c < 3; ++c) bounds.add(mesh.positions[mesh.triangles[t][c]]);
  return bounds;
}

template <class T>
void copy_part(const std::vector<T>& from, std::size_t first, std::size_t count, std::vector<T>& to) {
  if (!from.empty()) std::copy_n(from.begin() + first, count, to.begin() + first);
}

// Whether the node's triangles have no other vertices than its own; sets `whole`.
bool has_own_vertices(const MeshData& mesh, NodePlace& node) {
  std::vector<bool> used(node.vertices, false);
  for (std::size_t t = 0; t < node.triangles; ++t)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[node.first_triangle + t][c] - node.first_vertex;  // or large
      if (v >= node.vertices) return false;
      used[v] = true;
    }
  node.whole = std::ranges::find(used, false) == used.end();
  return true;
}

// The pose of a mesh that was never posed; null: its nodes share vertices or are out of order.
std::shared_ptr<const MeshPose> first_pose(const Scene& scene) {
  const Mesh& mesh = *scene.mesh;
  auto pose = std::make_shared<MeshPose>();
  pose->first = scene.mesh;
  std::size_t triangles = 0, vertices = 0;  // of the nodes before
  for (const Node& node : scene.nodes->nodes) {
    NodePlace& place = pose->nodes.emplace_back();
    place.first_vertex = node.first_vertex;
    place.vertices = node.vertices;
    place.first_triangle = node.first_triangle;
    place.triangles = node.triangles;
    if (node.triangles == 0 && node.vertices == 0) continue;
    const std::size_t last_triangle = std::size_t{node.first_triangle} + node.triangles,
                      last_vertex = std::size_t{node.first_vertex} + node.vertices;
    if (node.first_triangle < triangles || node.first_vertex < vertices ||
        last_triangle > mesh.triangles.size() || last_vertex > mesh.positions.size() ||
        !has_own_vertices(mesh, place))
      return nullptr;
    place.bounds = bounds_of(place, mesh);
    pose->others.add(bounds_of(mesh, triangles, node.first_triangle));
    triangles = last_triangle;
    vertices = last_vertex;
  }
  pose->others.add(bounds_of(mesh, triangles, mesh.triangles.size()));
  return pose;
}

// Fewer vertices are placed by one thread; more threads would wait for memory.
constexpr std::size_t kForThreads = 8192;
constexpr unsigned kMostThreads = 8;

}  // namespace

std::shared_ptr<PosePool> make_pose_pool() {
  return std::make_shared<PosePool>();
}

Bounds bounds_of(const NodePlace& node, const MeshData& mesh) {
  if (!node.whole)
    return bounds_of(mesh, node.first_triangle, std::size_t{node.first_triangle} + node.triangles);
  Bounds bounds;
  for (std::size_t v = 0; v < node.vertices; ++v) bounds.add(mesh.positions[node.first_vertex + v]);
  return bounds;
}

Bounds MeshPose::bounds() const {
  Bounds all = others;
  for (const NodePlace& node : nodes) all.add(node.bounds);
  return all;
}

std::vector<const NodePlace*> MeshPose::moved_since(const MeshPose& other) const {
  std::vector<const NodePlace*> moved;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (!nodes[n].same_as(other.nodes[n])) moved.push_back(&nodes[n]);
  return moved;
}

std::uint64_t PosePool::next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

void PosePool::for_each(std::size_t n, std::size_t vertices, const std::function<void(std::size_t)>& body) {
  if (n < 2 || vertices < kForThreads) {
    for (std::size_t i = 0; i < n; ++i) body(i);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    if (!workers_)
      workers_.emplace(as_int(std::clamp(std::thread::hardware_concurrency(), 1u, kMostThreads)));
  }
  workers_->for_each(n, body);
}

std::shared_ptr<const MeshPose> PosePool::pose_of(const Scene& scene) {
  if (scene.mesh->pose()) return scene.mesh->pose();
  const std::lock_guard lock(mutex_);
  if (!first_ || first_->first.lock() != scene.mesh) first_ = first_pose(scene);
  return first_;
}

std::unique_ptr<Mesh> PosePool::pop(const MeshPose& pose) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::ranges::find_if(left_, [&](const auto& m) { return m->pose_->is_of_same_mesh(pose); });
  if (found == left_.end()) return nullptr;
  std::unique_ptr<Mesh> mesh = std::move(*found);
  left_.erase(found);
  return mesh;
}

std::unique_ptr<Mesh> PosePool::like(const Scene& scene, const MeshPose& pose,
                                     const std::vector<bool>& placed) {
  std::unique_ptr<Mesh> mesh = pop(pose);
  const Mesh& from = *scene.mesh;
  if (!mesh) return std::make_unique<Mesh>(from);
  const std::vector<NodePlace>& was = mesh->pose_->nodes;
  for (std::size_t n = 0; n < was.size(); ++n) {
    if (!placed[n] && was[n].same_as(pose.nodes[n])) continue;
    const Node& node = scene.nodes->nodes[n];
    copy_part(from.triangles, node.first_triangle, node.triangles, mesh->triangles);
    if (placed[n]) continue;
    copy_part(from.positions, node.first_vertex, node.vertices, mesh->positions);
    copy_part(from.normals, node.first_vertex, node.vertices, mesh->normals);
    copy_part(from.tangents, node.first_vertex, node.vertices, mesh->tangents);
  }
  return mesh;
}

std::shared_ptr<const Mesh> PosePool::finish(std::unique_ptr<Mesh> mesh,
                                             std::shared_ptr<const MeshPose> pose) {
  mesh->bounds_ = pose->bounds();
  mesh->pose_ = std::move(pose);
  return {mesh.release(), [pool = weak_from_this()](const Mesh* left) {
            std::unique_ptr<Mesh> own(const_cast<Mesh*>(left));  // made here, as one that is not const
            if (const std::shared_ptr<PosePool> to = pool.lock()) to->put_back(std::move(own));
          }};
}

void PosePool::put_back(std::unique_ptr<Mesh> mesh) {
  std::unique_ptr<Mesh> oldest;  // freed without the lock
  const std::lock_guard lock(mutex_);
  left_.push_back(std::move(mesh));
  if (left_.size() <= kMostLeft) return;
  oldest = std::move(left_.front());
  left_.erase(left_.begin());
}

}  // namespace pinocchio
