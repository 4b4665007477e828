#include "core/scene/gltf/save/motion.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <map>

#include "core/scene/gltf/save/materials.h"
#include "core/scene/gltf/save/mesh.h"
#include "core/scene/pose/pose.h"
#include "pinocchio/animation.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = GltfData::Json;

constexpr std::size_t kInfluencesASet = 4;

// The tracks that replace the node's transform. Null: there are none.
const AnimatedNode* animated_by(const Animation& animation, std::size_t node) {
  const auto found = std::ranges::find(animation.nodes, as_int(node), &AnimatedNode::node);
  const auto moves = [](const Track& t) { return t.path != Track::Path::weights; };
  return found != animation.nodes.end() && std::ranges::any_of(found->tracks, moves) ? &*found : nullptr;
}

// In its parts where tracks take their place, else a matrix.
void add_transform(const Node& node, const AnimatedNode* animated, Json& json) {
  if (!animated) {
    if (node.local != glm::mat4(1.0f))
      json["matrix"] = std::vector<float>(glm::value_ptr(node.local), glm::value_ptr(node.local) + 16);
    return;
  }
  const NodeMotion& rest = animated->at_rest;
  json["translation"] = vec3_json(rest.translation);
  json["rotation"] = {rest.rotation.x, rest.rotation.y, rest.rotation.z, rest.rotation.w};
  json["scale"] = vec3_json(rest.scale);
}

// A morph target's offsets, one each vertex of its node.
std::vector<glm::vec3> of_all_vertices(const MorphTarget& target, const std::vector<glm::vec3>& offsets,
                                       std::uint32_t vertices) {
  std::vector<glm::vec3> all(vertices, glm::vec3(0.0f));
  for (std::size_t i = 0; i < offsets.size(); ++i) all[target.vertices[i]] = offsets[i];
  return all;
}

Json targets_json(const Deformation& deformation, std::uint32_t vertices, GltfData& data) {
  Json targets = Json::array();
  for (const MorphTarget& target : deformation.targets) {
    const auto add = [&](const std::vector<glm::vec3>& offsets) {
      return data.add_accessor(std::span<const glm::vec3>(of_all_vertices(target, offsets, vertices)),
                               kGltfFloat, "VEC3");
    };
    Json json{{"POSITION", add_positions(of_all_vertices(target, target.positions, vertices), data)}};
    if (!target.normals.empty()) json["NORMAL"] = add(target.normals);
    if (!target.tangents.empty()) json["TANGENT"] = add(target.tangents);
    targets.push_back(std::move(json));
  }
  return targets;
}

// JOINTS_n and WEIGHTS_n of a node that follows a skin.
Json influences_json(const Deformation& deformation, std::uint32_t vertices, GltfData& data) {
  Json attributes = Json::object();
  if (deformation.skin < 0) return attributes;
  const std::size_t stride = deformation.influences_per_vertex;
  for (std::size_t set = 0; set * kInfluencesASet < stride; ++set) {
    std::vector<glm::u16vec4> joints(vertices);
    std::vector<glm::vec4> weights(vertices);
    for (std::size_t v = 0; v < vertices; ++v)
      for (std::size_t i = 0; i < kInfluencesASet; ++i) {
        const Influence& by = deformation.influences[v * stride + set * kInfluencesASet + i];
        joints[v][as_int(i)] = static_cast<std::uint16_t>(by.joint);
        weights[v][as_int(i)] = by.weight;
      }
    const std::string number = "_" + std::to_string(set);
    attributes["JOINTS" + number] =
        data.add_accessor(std::span<const glm::u16vec4>(joints), kGltfUnsignedShort, "VEC4");
    attributes["WEIGHTS" + number] =
        data.add_accessor(std::span<const glm::vec4>(weights), kGltfFloat, "VEC4");
  }
  return attributes;
}

template <class T>
std::span<const T> part_of(const std::vector<T>& all, const Node& node) {
  return all.empty() ? std::span<const T>() : std::span(all).subspan(node.first_vertex, node.vertices);
}

// A mesh of the node's own vertices, as it sees them.
void add_mesh(const Scene& scene, std::size_t index, const std::vector<glm::mat4>& world, GltfData& data,
              Json& json) {
  const NodeTree& tree = *scene.nodes;
  const RestPose& rest = *tree.rest;
  const Node& node = tree.nodes[index];
  SavedPart part{node.first_vertex,
                 node.first_triangle,
                 node.triangles,
                 part_of(rest.positions, node),
                 part_of(rest.normals, node),
                 scene.mesh->tangents.empty() ? std::span<const glm::vec4>() : part_of(rest.tangents, node),
                 Placement(world[index]).mirrors()};
  const auto found = std::ranges::find(rest.deformations, as_int(index), &Deformation::node);
  if (found == rest.deformations.end()) {
    data.json["meshes"].push_back({{"primitives", gltf_primitives(*scene.mesh, part, Json::object(), data)}});
  } else {
    const auto d = as_size(found - rest.deformations.begin());
    part.turned = Deformer(tree, d, world).mirrors();
    Json primitives = gltf_primitives(*scene.mesh, part, influences_json(*found, node.vertices, data), data);
    if (const Json targets = targets_json(*found, node.vertices, data); !targets.empty())
      for (Json& primitive : primitives) primitive["targets"] = targets;
    data.json["meshes"].push_back({{"primitives", std::move(primitives)}});
    if (!tree.weights[d].empty()) data.json["meshes"].back()["weights"] = tree.weights[d];
    if (found->skin >= 0) json["skin"] = found->skin;
  }
  json["mesh"] = data.json["meshes"].size() - 1;
}

const char* path_name(Track::Path path) {
  constexpr const char* kNames[] = {"translation", "rotation", "scale", "weights"};
  return kNames[as_int(path)];
}

Json sampler_json(const Track& track, GltfData& data) {
  constexpr const char* kInterpolations[] = {"STEP", "LINEAR", "CUBICSPLINE"};
  Json json{{"input", data.add_accessor(std::span(track.times_s), kGltfFloat, "SCALAR")}};
  data.add_bounds({track.times_s.front()}, {track.times_s.back()});
  json["interpolation"] = kInterpolations[as_int(track.interpolation)];
  const std::span values(track.values);
  const auto elements = [&]<class T>(const T*) {
    return std::span(reinterpret_cast<const T*>(values.data()), values.size() / track.width);
  };
  if (track.path == Track::Path::weights)
    json["output"] = data.add_accessor(values, kGltfFloat, "SCALAR");
  else if (track.path == Track::Path::rotation)
    json["output"] = data.add_accessor(elements(static_cast<const glm::vec4*>(nullptr)), kGltfFloat, "VEC4");
  else
    json["output"] = data.add_accessor(elements(static_cast<const glm::vec3*>(nullptr)), kGltfFloat, "VEC3");
  return json;
}

}  // namespace

bool can_save_motion(const Scene& scene) {
  if (!scene.animation || !scene.nodes) return false;
  std::size_t triangles = 0;
  for (const Node& node : scene.nodes->nodes) triangles += node.triangles;
  return triangles == scene.mesh->triangles.size();
}

std::vector<int> add_moving_nodes(const Scene& scene, GltfData& data) {
  const std::vector<Node>& nodes = scene.nodes->nodes;
  const std::vector<glm::mat4> world = world_matrices(nodes);
  std::vector<int> place;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Json json{{"name", nodes[n].name}};
    add_transform(nodes[n], animated_by(*scene.animation, n), json);
    if (nodes[n].triangles > 0) add_mesh(scene, n, world, data, json);
    place.push_back(data.add_node(std::move(json), nodes[n].parent < 0));
    if (nodes[n].parent >= 0) {
      const auto parent = as_size(place[nodes[n].parent]);
      data.json["nodes"][parent]["children"].push_back(place.back());
    }
  }
  return place;
}

std::vector<glm::mat4> world_at_rest(const Scene& scene) {
  std::vector<Node> nodes = scene.nodes->nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (const AnimatedNode* animated = animated_by(*scene.animation, n))
      nodes[n].local = animated->at_rest.matrix();
  return world_matrices(nodes);
}

void add_skins_and_animation(const Scene& scene, const std::vector<int>& place_of_node, GltfData& data) {
  for (const Skin& skin : scene.nodes->rest->skins) {
    Json joints = Json::array();
    for (const int joint : skin.joints) joints.push_back(place_of_node[joint]);
    const int matrices = data.add_accessor(std::span(skin.joint_from_mesh), kGltfFloat, "MAT4");
    data.json["skins"].push_back({{"joints", joints}, {"inverseBindMatrices", matrices}});
  }
  struct Clip {
    Json samplers = Json::array(), channels = Json::array();
  };
  std::map<std::size_t, Clip> clips;
  for (const AnimatedNode& node : scene.animation->nodes)
    for (const Track& track : node.tracks) {
      Clip& clip = clips[track.clip];
      clip.channels.push_back(
          {{"sampler", clip.samplers.size()},
           {"target", {{"node", place_of_node[node.node]}, {"path", path_name(track.path)}}}});
      clip.samplers.push_back(sampler_json(track, data));
    }
  for (const auto& [index, clip] : clips) {
    const bool named = index < scene.animation->clips.size();
    data.json["animations"].push_back({{"name", named ? scene.animation->clips[index].name : ""},
                                       {"samplers", clip.samplers},
                                       {"channels", clip.channels}});
  }
}

}  // namespace pinocchio
