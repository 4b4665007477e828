#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>

#include "core/math/finite.h"
#include "core/scene/gltf_deformation.h"
#include "core/scene/loaders.h"
#include "core/scene/pose.h"

namespace pinocchio {
namespace {

glm::mat4 matrix_of(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return glm::mat4(glm::make_mat4(node.matrix.data()));
  return gltf_motion(node).matrix();
}

glm::vec3 direction_of(const glm::mat4& world, const glm::vec3& local) {
  const glm::vec3 d(world * glm::vec4(local, 0.0f));
  const float length = glm::length(d);
  return length > 0.0f ? d / length : local;
}

std::optional<float> length_member(const tinygltf::Value* extras, const char* key) {
  const std::optional<float> size = number_member(extras, key);
  return size && *size >= 0.0f && std::isfinite(*size) ? size : std::nullopt;
}

// Its sides lie along the node's x and y, it faces -z.
void make_rectangle(const glm::vec2& sides, const glm::mat4& world, Light& light) {
  light.kind = Light::Kind::rectangle;
  light.edge_u = glm::vec3(world * glm::vec4(sides.x, 0.0f, 0.0f, 0.0f));
  light.edge_v = glm::vec3(world * glm::vec4(0.0f, sides.y, 0.0f, 0.0f));
}

Light light_of(const tinygltf::Light& l, const tinygltf::Node& node, const glm::mat4& world) {
  Light light;
  light.name = !l.name.empty() ? l.name : node.name;
  light.kind = l.type == "directional" ? Light::Kind::directional
               : l.type == "spot"      ? Light::Kind::spot
                                       : Light::Kind::point;
  light.position = glm::vec3(world[3]);
  light.direction = direction_of(world, {0, 0, -1});
  if (l.color.size() == 3) light.color = glm::vec3(glm::make_vec3(l.color.data()));
  light.intensity = static_cast<float>(l.intensity);
  light.falloff =
      light.kind == Light::Kind::directional ? Light::Falloff::none : Light::Falloff::inverse_square;
  if (l.range > 0.0) light.range = static_cast<float>(l.range);
  if (light.kind == Light::Kind::spot) {
    light.cos_inner = static_cast<float>(std::cos(l.spot.innerConeAngle));
    light.cos_outer = static_cast<float>(std::cos(l.spot.outerConeAngle));
  }
  for (const tinygltf::Value* extras : {our_extras(l.extras), our_extras(node.extras)}) {
    light.casts_shadow = bool_member(extras, "castsShadow").value_or(light.casts_shadow);
    light.radius = length_member(extras, "radius").value_or(light.radius);
    light.angle_deg = std::min(length_member(extras, "angle").value_or(light.angle_deg), 180.0f);
    if (const std::optional<glm::vec2> sides = vec2_member(extras, "rectangle"))
      make_rectangle(*sides, world, light);
    const tinygltf::Value* falloff = extras ? member(*extras, "falloff") : nullptr;
    if (falloff && falloff->IsString() && falloff->Get<std::string>() == "none")
      light.falloff = Light::Falloff::none;
  }
  return light;
}

// Looks along -Z; how far the target is, only `target` of our extras tells.
Camera camera_of(const tinygltf::Camera& c, const tinygltf::Node& node, const glm::mat4& world) {
  Camera camera;
  camera.name = !node.name.empty() ? node.name : c.name;
  camera.eye = glm::vec3(world[3]);
  camera.target = camera.eye + direction_of(world, {0, 0, -1});
  camera.up = direction_of(world, {0, 1, 0});
  const std::optional<glm::vec3> target = vec3_member(our_extras(node.extras), "target");
  if (target && *target != camera.eye) camera.target = *target;
  const std::optional<glm::vec3> up = vec3_member(our_extras(node.extras), "up");
  if (up && *up != glm::vec3(0.0f)) camera.up = *up;
  camera.fov_deg = static_cast<float>(glm::degrees(c.perspective.yfov));
  camera.lens_radius = length_member(our_extras(node.extras), "lensRadius").value_or(0.0f);
  camera.focus_distance = length_member(our_extras(node.extras), "focusDistance").value_or(0.0f);
  return camera;
}

// As the node sees it.
Light at_rest(const glm::mat4& world, Light light) {
  const Placement to_node(glm::inverse(world));
  const glm::vec3 origin = to_node.position(glm::vec3(0.0f));
  light.edge_u = to_node.position(light.edge_u) - origin;
  light.edge_v = to_node.position(light.edge_v) - origin;
  light.position = glm::vec3(0.0f);
  light.direction = {0, 0, -1};
  return light;
}
Camera at_rest(const glm::mat4& world, Camera camera) {
  const Placement to_node(glm::inverse(world));
  camera.eye = glm::vec3(0.0f);
  camera.target = to_node.position(camera.target);
  camera.up = to_node.direction(camera.up);
  return camera;
}

bool can_look(const Camera& camera) {
  return camera.fov_deg > 0.0f && camera.fov_deg < 180.0f && is_finite(camera.eye) &&
         is_finite(camera.target) && is_finite(camera.up);
}

bool can_shine(const Light& light) {
  return is_finite(light.position) && is_finite(light.direction) && is_finite(light.edge_u) &&
         is_finite(light.edge_v) && is_finite(light.intensity * light.color);
}

// Texture coordinates and tangents that no map asks for.
void drop_unused_attributes(MeshData& mesh, RestPose& rest) {
  bool set0 = false, set1 = false, normals = false;
  for (const MaterialMaps& m : mesh.maps) {
    for (const TextureUse* use : m.uses())
      if (use->used()) (use->uv_set == 1 ? set1 : set0) = true;
    normals = normals || m.normal.used();
  }
  const auto given = [](const glm::vec4& t) { return t.w != 0.0f; };
  // Where a texture lies on primitives without coordinates, they are zeros.
  const std::size_t vertices = mesh.positions.size();
  const auto keep = [vertices](bool needed, std::vector<glm::vec2>& texcoords) {
    needed ? texcoords.resize(vertices) : std::vector<glm::vec2>().swap(texcoords);
  };
  keep(set0, mesh.texcoords);
  keep(set1, mesh.texcoords1);
  if (!normals || std::none_of(mesh.tangents.begin(), mesh.tangents.end(), given))
    mesh.tangents = {}, rest.tangents = {};
  const auto colored = [](const glm::vec4& c) { return c != glm::vec4(1.0f); };
  if (std::none_of(mesh.colors.begin(), mesh.colors.end(), colored)) mesh.colors = {};
}

class SceneReader {
 public:
  SceneReader(const GltfFile& file, Loading& loading) : file_(file), model_(file.model), loading_(loading) {
    add_gltf_materials(file, mesh_);
  }

  Expected<Scene> read() {
    const std::vector<int> roots = this->roots();
    if (const Expected<void> fits = take_gltf_memory(file_, roots); !fits) return Unexpected(fits.error());
    std::vector<Placed> open;
    for (const int root : roots) open.push_back({root, -1, glm::mat4(1.0f)});
    std::reverse(open.begin(), open.end());  // the file's order, from the back
    std::vector<bool> seen(model_.nodes.size(), false);
    begin_phase(file_.progress, "mesh", static_cast<double>(model_.nodes.size()));
    while (!open.empty()) {
      advance(file_.progress);
      const Placed at = open.back();
      open.pop_back();
      if (at.node < 0 || static_cast<std::size_t>(at.node) >= model_.nodes.size())
        return file_.error("names node " + std::to_string(at.node) + ", there are " +
                           std::to_string(model_.nodes.size()));
      const auto index = static_cast<std::size_t>(at.node);
      if (seen[index])
        return file_.error("reaches node " + std::to_string(at.node) + " twice: nodes are no tree");
      seen[index] = true;
      const tinygltf::Node& node = model_.nodes[index];
      const glm::mat4 local = matrix_of(node), world = at.world_from_parent * local;
      place_of_node_[index] = static_cast<int>(tree_.nodes.size());
      begin(node, at.parent, local);
      if (const Expected<void> added = add(node, world); !added) return Unexpected(added.error());
      end(world);
      const int place = static_cast<int>(tree_.nodes.size()) - 1;
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        open.push_back({*child, place, world});
    }
    finish();
    if (const Expected<void> skinned = add_skins(); !skinned) return Unexpected(skinned.error());
    scene_.mesh = std::make_shared<const Mesh>(std::move(mesh_));
    Expected<std::shared_ptr<const Animation>> animation =
        gltf_animation(file_, tree_, place_of_node_, loading_.warnings);
    if (!animation) return Unexpected(animation.error());
    scene_.animation = std::move(*animation);
    scene_.nodes = std::make_shared<const NodeTree>(std::move(tree_));
    return std::move(scene_);
  }

 private:
  struct Placed {
    int node, parent;  // in the file; in tree_
    glm::mat4 world_from_parent;
  };

  // What is added between the two moves with this node.
  void begin(const tinygltf::Node& node, int parent, const glm::mat4& local) {
    tree_.nodes.push_back({node.name, parent, local, static_cast<std::uint32_t>(mesh_.positions.size()), 0,
                           static_cast<std::uint32_t>(mesh_.triangles.size()), 0});
    lights_before_ = scene_.lights.size();
    cameras_before_ = scene_.cameras.size();
  }
  void end(const glm::mat4& world) {
    Node& node = tree_.nodes.back();
    node.vertices = static_cast<std::uint32_t>(mesh_.positions.size()) - node.first_vertex;
    node.triangles = static_cast<std::uint32_t>(mesh_.triangles.size()) - node.first_triangle;
    const int index = static_cast<int>(tree_.nodes.size()) - 1;
    for (std::size_t i = lights_before_; i < scene_.lights.size(); ++i)
      rest_.lights.push_back({index, i, at_rest(world, scene_.lights[i])});
    for (std::size_t i = cameras_before_; i < scene_.cameras.size(); ++i)
      rest_.cameras.push_back({index, i, at_rest(world, scene_.cameras[i])});
  }

  // The default scene's, else the first scene's, else every node that is nobody's child.
  [[nodiscard]] std::vector<int> roots() const {
    const auto scenes = static_cast<int>(model_.scenes.size());
    if (scenes > 0)
      return model_
          .scenes[static_cast<std::size_t>(
              model_.defaultScene >= 0 && model_.defaultScene < scenes ? model_.defaultScene : 0)]
          .nodes;
    std::vector<bool> is_child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
      for (const int child : node.children)
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
          is_child[static_cast<std::size_t>(child)] = true;
    std::vector<int> found;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) found.push_back(static_cast<int>(i));
    return found;
  }

  Expected<void> add(const tinygltf::Node& node, const glm::mat4& world) {
    if (node.mesh >= 0) {
      const auto default_material = static_cast<std::uint32_t>(mesh_.materials.size() - 1);
      Expected<std::vector<glm::mat4>> instances = instances_of(node);
      if (!instances) return Unexpected(instances.error());
      if (node.skin >= static_cast<int>(model_.skins.size()))
        return file_.error("a node names skin " + std::to_string(node.skin) + ", there are " +
                           std::to_string(model_.skins.size()));
      DeformationReader deformation(file_, node, tree_.nodes.back().first_vertex, loading_.warnings);
      for (const glm::mat4& instance : *instances) {
        const std::size_t first = mesh_.positions.size();
        const Expected<void> added =
            add_gltf_mesh(file_, node.mesh, world * instance, default_material, mesh_, rest_,
                          deformation.needed() ? &deformation : nullptr, loading_.warnings);
        if (!added) return added;
        deformation.place(instance, static_cast<std::uint32_t>(first),
                          std::span(rest_.normals).subspan(first));
        if (instance != glm::mat4(1.0f)) place_rest(Placement(instance), first);
      }
      if (deformation.needed()) add_deformation(node, deformation);
    }
    if (node.camera >= 0 && static_cast<std::size_t>(node.camera) < model_.cameras.size()) {
      const tinygltf::Camera& camera = model_.cameras[static_cast<std::size_t>(node.camera)];
      const Camera ours = camera_of(camera, node, world);
      if (camera.type != "perspective") {
        warn("camera '" + ours.name + "'", "is not perspective and left out", "it cannot be looked through");
      } else if (!can_look(ours)) {
        warn("camera '" + ours.name + "'", "has no field of view within 0 and 180 degrees and is left out",
             "it cannot be looked through");
      } else {
        scene_.cameras.push_back(ours);
      }
    }
    const std::optional<float> light =
        number_member(extension(node.extensions, "KHR_lights_punctual"), "light");
    if (light) {
      if (!(*light >= 0.0f && *light < static_cast<float>(model_.lights.size())))
        return file_.error("a node names a light that there is not, there are " +
                           std::to_string(model_.lights.size()));
      const Light ours = light_of(model_.lights[static_cast<std::size_t>(*light)], node, world);
      if (can_shine(ours)) {
        scene_.lights.push_back(ours);
      } else {
        warn("light '" + ours.name + "'", "is not of finite numbers and left out", "its light is missing");
      }
    }
    return {};
  }

  // Its weights are the file's; what they and its skin make of the mesh is done when all nodes are known.
  void add_deformation(const tinygltf::Node& node, DeformationReader& reader) {
    rest_.deformations.push_back(reader.take());
    rest_.deformations.back().node = static_cast<int>(tree_.nodes.size()) - 1;
    rest_.deformations.back().skin = reader.skinned() ? node.skin : -1;  // the file's yet
    tree_.weights.push_back(reader.weights());
  }

  // Gives deformations the skins that they use, and places what they make.
  Expected<void> add_skins() {
    std::map<int, int> skins;  // by the file's
    for (Deformation& deformation : rest_.deformations) {
      if (deformation.skin < 0) continue;
      const auto [at, is_new] = skins.try_emplace(deformation.skin, -1);
      if (is_new) {
        Expected<std::optional<Skin>> skin = gltf_skin(file_, at->first, place_of_node_);
        if (!skin) return Unexpected(skin.error());
        if (*skin) {
          at->second = static_cast<int>(rest_.skins.size());
          rest_.skins.push_back(std::move(**skin));
        } else {
          warn("skin " + std::to_string(at->first), "skins of joints that are not in the scene are left out",
               "what they cover stays as its node has it");
        }
      }
      deformation.skin = at->second;
    }
    tree_.rest = std::make_shared<const RestPose>(std::move(rest_));
    const std::vector<glm::mat4> world = world_matrices(tree_.nodes);
    for (std::size_t d = 0; d < tree_.weights.size(); ++d) {
      const Deformation& deformation = tree_.rest->deformations[d];
      const bool weighs = std::ranges::any_of(tree_.weights[d], [](float w) { return w != 0.0f; });
      if (deformation.skin < 0 && !weighs) continue;  // as it stands
      const Node& node = tree_.nodes[static_cast<std::size_t>(deformation.node)];
      const Deformer deformer(tree_, d, world);
      deformer.place(mesh_);
      if (deformer.mirrors() != Placement(world[static_cast<std::size_t>(deformation.node)]).mirrors())
        turn_around(node, mesh_);
    }
    return {};
  }

  // An instance rests where its node has it, not where its mesh is.
  void place_rest(const Placement& instance, std::size_t first) {
    for (std::size_t i = first; i < rest_.positions.size(); ++i) {
      rest_.positions[i] = instance.position(rest_.positions[i]);
      rest_.normals[i] = instance.normal(rest_.normals[i]);
      if (!rest_.tangents.empty()) rest_.tangents[i] = instance.tangent(rest_.tangents[i]);
    }
  }

  // Where EXT_mesh_gpu_instancing places copies of the node's mesh; without it, one in place.
  [[nodiscard]] Expected<std::vector<glm::mat4>> instances_of(const tinygltf::Node& node) const {
    const tinygltf::Value* instancing = extension(node.extensions, "EXT_mesh_gpu_instancing");
    const tinygltf::Value* attributes = instancing ? member(*instancing, "attributes") : nullptr;
    if (!attributes) return std::vector{glm::mat4(1.0f)};
    std::vector<float> values[3];
    std::size_t count = 0;
    constexpr struct {
      const char* name;
      int components;
    } kAttributes[] = {{"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}};
    for (int i = 0; i < 3; ++i) {
      const std::optional<float> accessor = number_member(attributes, kAttributes[i].name);
      if (!accessor) continue;
      Expected<std::vector<float>> read =
          file_.floats(*accessor >= 0.0f && *accessor < 1e9f ? static_cast<int>(*accessor) : -1,
                       kAttributes[i].components);
      if (!read) return Unexpected(read.error());
      const std::size_t elements = read->size() / static_cast<std::size_t>(kAttributes[i].components);
      if (count != 0 && elements != count)
        return file_.error("a node's instances have attributes of different lengths");
      count = elements;
      values[i] = std::move(*read);
    }
    std::vector<glm::mat4> instances;
    for (std::size_t i = 0; i < count; ++i) {
      tinygltf::Node local;
      for (std::size_t c = 0; c < 3 && !values[0].empty(); ++c)
        local.translation.push_back(values[0][3 * i + c]);
      for (std::size_t c = 0; c < 4 && !values[1].empty(); ++c)
        local.rotation.push_back(values[1][4 * i + c]);
      for (std::size_t c = 0; c < 3 && !values[2].empty(); ++c) local.scale.push_back(values[2][3 * i + c]);
      instances.push_back(matrix_of(local));
    }
    return instances;
  }

  void warn(const std::string& where, const std::string& what, const std::string& lost) {
    loading_.warnings.add({file_.path.string(), where, what, lost});
  }

  void finish() {
    scene_.source_files = file_.named_files;
    add_gltf_textures(file_, mesh_, loading_);
    drop_unused_attributes(mesh_, rest_);
    if (!model_.scenes.empty()) {
      const int shown = model_.defaultScene >= 0 ? model_.defaultScene : 0;
      const auto i = std::min(static_cast<std::size_t>(shown), model_.scenes.size() - 1);
      scene_.ambient_light =
          vec3_member(our_extras(model_.scenes[i].extras), "ambient").value_or(scene_.ambient_light);
      scene_.environment = gltf_environment(file_, model_.scenes[i], loading_);
    }
    const auto last = static_cast<std::uint32_t>(mesh_.materials.size() - 1);
    if (std::find(mesh_.triangle_materials.begin(), mesh_.triangle_materials.end(), last) ==
            mesh_.triangle_materials.end() &&
        last > 0)
      mesh_.materials.pop_back();  // nobody needs the default
  }

  const GltfFile& file_;
  const tinygltf::Model& model_;
  Loading& loading_;
  Scene scene_;
  MeshData mesh_;
  NodeTree tree_;
  RestPose rest_;
  std::vector<int> place_of_node_ = std::vector<int>(model_.nodes.size(), -1);  // of the file's, in tree_
  std::size_t lights_before_ = 0, cameras_before_ = 0;
};

}  // namespace

Expected<Scene> load_gltf(const std::filesystem::path& path, Loading& loading) {
  const Expected<GltfFile> file = read_gltf_file(path, loading);
  if (!file) return Unexpected(file.error());
  return SceneReader(*file, loading).read();
}

}  // namespace pinocchio
