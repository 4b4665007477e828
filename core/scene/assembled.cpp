#include <algorithm>

#include "core/scene/pose/pose.h"
#include "pinocchio/animation.h"
#include "pinocchio/conversion.h"
#include "pinocchio/load.h"

namespace pinocchio {
namespace {

template <class T>
void append(const std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

// Adds parts to a scene; their nodes place them at the end.
class Assembly {
 public:
  void add(const Part& part) {
    const Scene& scene = part.scene;
    const int root = as_int(tree_.nodes.size());
    Node node{part.name, -1, part.world_from_part, count(mesh_.positions), 0, count(mesh_.triangles), 0};
    if (!scene.nodes) {
      node.vertices = count(scene.mesh->positions);
      node.triangles = count(scene.mesh->triangles);
    }
    tree_.nodes.push_back(node);
    if (scene.nodes) add_nodes(*scene.nodes, root);
    const RestPose nothing;
    const RestPose& of_part = scene.nodes ? *scene.nodes->rest : nothing;
    const AttachedPlaces places = attached_places(of_part, scene);
    add_attached(scene.lights, of_part.lights, places.lights, root, result_.lights, rest_.lights);
    add_attached(scene.cameras, of_part.cameras, places.cameras, root, result_.cameras, rest_.cameras);
    add_mesh(*scene.mesh, scene.nodes ? scene.nodes->rest.get() : nullptr);
    if (scene.animation) add_animation(*scene.animation, root);
    if (root == 0) {
      result_.ambient_light = scene.ambient_light;
      result_.environment = scene.environment;
    }
  }

  Expected<Scene> finish() {
    // Triangles that the part's matrices mirrored are turned around already.
    const std::vector<glm::mat4> world = world_matrices(tree_.nodes);
    std::vector<bool> deforms(world.size(), false);
    for (const Deformation& d : rest_.deformations) deforms[d.node] = true;
    const AttachedPlaces places = attached_places(rest_, result_);
    for (std::size_t n = 0; n < world.size(); ++n) {
      const Placement placement(world[n]);
      place_attached(rest_, places, as_int(n), placement, result_);
      if (deforms[n]) continue;
      place_vertices(tree_.nodes[n], placement, rest_, mesh_);
      if (placement.mirrors() != mirrored_[n]) turn_around(tree_.nodes[n], mesh_);
    }
    tree_.rest = std::make_shared<const RestPose>(std::move(rest_));
    for (std::size_t d = 0; d < tree_.rest->deformations.size(); ++d) {
      const auto n = as_size(tree_.rest->deformations[d].node);
      const Deformer deformer(tree_, d, world);
      deformer.place(mesh_);
      if (deformer.mirrors() != mirrored_[n]) turn_around(tree_.nodes[n], mesh_);
    }
    if (!animation_.nodes.empty())
      result_.animation = std::make_shared<const Animation>(std::move(animation_));
    result_.nodes = std::make_shared<const NodeTree>(std::move(tree_));
    result_.mesh = std::make_shared<const Mesh>(std::move(mesh_));
    if (const Expected<void> checked = check_scene(result_); !checked) return Unexpected(checked.error());
    return std::move(result_);
  }

 private:
  template <class T>
  static std::uint32_t count(const std::vector<T>& of) {
    return as_uint32(of.size());
  }

  void add_nodes(const NodeTree& tree, int root) {
    mirrored_.push_back(false);  // the root has no triangles
    const std::vector<glm::mat4> world = world_matrices(tree.nodes);
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      Node node = tree.nodes[n];
      node.parent = node.parent < 0 ? root : node.parent + root + 1;
      node.first_vertex += count(mesh_.positions);
      node.first_triangle += count(mesh_.triangles);
      tree_.nodes.push_back(node);
      mirrored_.push_back(Placement(world[n]).mirrors());
    }
    for (MeshCopy copy : tree.rest->copies) {
      copy.node += root + 1;
      copy.mesh += meshes_;
      copy.first_vertex += count(mesh_.positions);
      copy.first_triangle += count(mesh_.triangles);
      rest_.copies.push_back(copy);
    }
    for (const MeshCopy& copy : rest_.copies) meshes_ = std::max(meshes_, copy.mesh + 1);
    const int skins = as_int(rest_.skins.size());
    for (Skin skin : tree.rest->skins) {
      for (int& joint : skin.joints) joint += root + 1;
      rest_.skins.push_back(std::move(skin));
    }
    for (std::size_t d = 0; d < tree.rest->deformations.size(); ++d) {
      Deformation deformation = tree.rest->deformations[d];
      deformation.node += root + 1;
      if (deformation.skin >= 0) deformation.skin += skins;
      mirrored_[deformation.node] = Deformer(tree, d, world).mirrors();
      rest_.deformations.push_back(std::move(deformation));
      tree_.weights.push_back(tree.weights[d]);
    }
  }

  void add_animation(const Animation& animation, int root) {
    const std::size_t clips = animation_.clips.size();
    append(animation.clips, animation_.clips);
    animation_.duration_s = std::max(animation_.duration_s, animation.duration_s);
    for (AnimatedNode node : animation.nodes) {
      node.node += root + 1;
      for (Track& track : node.tracks) track.clip += clips;
      animation_.nodes.push_back(std::move(node));
    }
  }

  // Lights and cameras without a node of their part are attached to the part's node.
  template <class T>
  void add_attached(const std::vector<T>& of_part, const std::vector<Attached<T>>& attached,
                    const std::vector<std::size_t>& places, int root, std::vector<T>& all,
                    std::vector<Attached<T>>& rest) {
    std::vector<bool> done(of_part.size(), false);
    for (std::size_t i = 0; i < attached.size(); ++i) {
      if (places[i] == kGone) continue;
      done[places[i]] = true;
      rest.push_back({attached[i].node + root + 1, places[i] + all.size(), attached[i].at_rest});
    }
    for (std::size_t i = 0; i < of_part.size(); ++i)
      if (!done[i]) rest.push_back({root, i + all.size(), of_part[i]});
    append(of_part, all);
  }

  void add_mesh(const Mesh& mesh, const RestPose* rest) {
    if (!rest) mirrored_.push_back(false);
    const auto vertices = count(mesh_.positions), materials = count(mesh_.materials);
    const auto textures = as_int(mesh_.textures.size());
    const auto maps = as_int(mesh_.maps.size());
    append(mesh.positions, mesh_.positions);
    append(mesh.normals, mesh_.normals);
    append(rest ? rest->positions : mesh.positions, rest_.positions);
    append(rest ? rest->normals : mesh.normals, rest_.normals);
    append_optional(mesh.texcoords, glm::vec2(0.0f), vertices, mesh_.texcoords);
    append_optional(mesh.texcoords1, glm::vec2(0.0f), vertices, mesh_.texcoords1);
    append_optional(mesh.colors, glm::vec4(1.0f), vertices, mesh_.colors);
    append_optional(mesh.tangents, glm::vec4(0.0f), vertices, mesh_.tangents);
    append_optional(rest ? rest->tangents : mesh.tangents, glm::vec4(0.0f), vertices, rest_.tangents);
    for (const glm::uvec3& t : mesh.triangles) mesh_.triangles.push_back(t + vertices);
    for (const std::uint32_t m : mesh.triangle_materials) mesh_.triangle_materials.push_back(m + materials);
    for (Material material : mesh.materials) {
      if (material.maps >= 0) material.maps += maps;
      mesh_.materials.push_back(std::move(material));
    }
    for (MaterialMaps of_material : mesh.maps) {
      for (TextureUse* use : of_material.uses())
        if (use->used()) use->texture += textures;
      mesh_.maps.push_back(of_material);
    }
    std::vector<Texture>& all = mesh_.textures.edit();
    all.insert(all.end(), mesh.textures.begin(), mesh.textures.end());
  }

  // Appends an attribute of vertices: any part that has it gives all parts one, `none` here where this one
  // has none. `before`: the number of vertices of earlier parts.
  template <class T>
  void append_optional(const std::vector<T>& from, const T& none, std::size_t before,
                       std::vector<T>& to) const {
    if (from.empty() && to.empty()) return;
    to.resize(before, none);
    append(from, to);
    to.resize(mesh_.positions.size(), none);
  }

  Scene result_;
  MeshData mesh_;
  NodeTree tree_;
  RestPose rest_;
  Animation animation_;
  int meshes_ = 0;              // the copies' numbers of meshes are below
  std::vector<bool> mirrored_;  // by node: its triangles are turned around
};

}  // namespace

Expected<Scene> assembled(std::span<const Part> parts) {
  Assembly assembly;
  for (const Part& part : parts) assembly.add(part);
  return assembly.finish();
}

}  // namespace pinocchio
