#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "core/scene/formats.h"
#include "core/scene/gltf/attached.h"
#include "core/scene/gltf/deformation.h"
#include "core/scene/gltf/format/json.h"
#include "core/scene/gltf/format/variants.h"
#include "core/scene/pose/pose.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

// Drops texture coordinates and tangents that no map uses, and colours that are all white.
void drop_unused_attributes(MeshData& mesh, RestPose& rest) {
  bool set0 = false, set1 = false, normals = false;
  for (const MaterialMaps& m : mesh.maps) {
    for (const TextureUse* use : m.uses())
      if (use->used()) (use->uv_set == 1 ? set1 : set0) = true;
    normals = normals || m.normal.used();
  }
  const auto given = [](const glm::vec4& t) { return t.w != 0.0f; };
  // Primitives without coordinates have zeros.
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
  SceneReader(const GltfFile& file, Loading& loading) : file_(file), loading_(loading) {
    add_gltf_materials(file, mesh_, loading_.options.shading);
  }

  Expected<Scene> read() {
    const std::vector<int> roots = this->roots();
    if (const Expected<void> fits = take_gltf_memory(file_, roots, loading_); !fits)
      return Unexpected(fits.error());
    std::vector<Placed> open;
    for (const int root : roots) open.push_back({root, -1, glm::mat4(1.0f)});
    std::reverse(open.begin(), open.end());  // popped in the file's order
    std::vector<bool> seen(file_.nodes.size(), false);
    begin_phase(file_.progress, "mesh", file_.nodes.size());
    while (!open.empty()) {
      advance(file_.progress);
      const Placed at = open.back();
      open.pop_back();
      if (!in_range(at.node, file_.nodes)) return file_.error("names node " + which_of(at.node, file_.nodes));
      const auto index = as_size(at.node);
      if (seen[index])
        return file_.error("reaches node " + std::to_string(at.node) +
                           " twice: it has two parents, or is among its own children");
      seen[index] = true;
      const GltfNode& node = file_.nodes[index];
      const glm::mat4 local = node.parent_from_node(), world = at.world_from_parent * local;
      place_of_node_[index] = as_int(tree_.nodes.size());
      begin(node, at.parent, local);
      if (const Expected<void> added = add(node, world); !added) return Unexpected(added.error());
      end(world);
      const int place = as_int(tree_.nodes.size()) - 1;
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        open.push_back({*child, place, world});
    }
    finish();
    if (const Expected<void> skinned = add_skins(); !skinned) return Unexpected(skinned.error());
    scene_.mesh = std::make_shared<const Mesh>(std::move(mesh_));
    Expected<std::shared_ptr<const Animation>> animation =
        gltf_animation(file_, tree_, place_of_node_, loading_.warnings, loading_.options.animation);
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

  // What is added between begin() and end() moves with this node.
  void begin(const GltfNode& node, int parent, const glm::mat4& local) {
    tree_.nodes.push_back({node.name, parent, local, as_uint32(mesh_.positions.size()), 0,
                           as_uint32(mesh_.triangles.size()), 0});
    lights_before_ = scene_.lights.size();
    cameras_before_ = scene_.cameras.size();
  }
  void end(const glm::mat4& world) {
    Node& node = tree_.nodes.back();
    node.vertices = as_uint32(mesh_.positions.size()) - node.first_vertex;
    node.triangles = as_uint32(mesh_.triangles.size()) - node.first_triangle;
    const int index = as_int(tree_.nodes.size()) - 1;
    for (std::size_t i = lights_before_; i < scene_.lights.size(); ++i)
      rest_.lights.push_back({index, i, at_rest(world, scene_.lights[i])});
    for (std::size_t i = cameras_before_; i < scene_.cameras.size(); ++i)
      rest_.cameras.push_back({index, i, at_rest(world, scene_.cameras[i])});
  }

  // The scene that is drawn: the default one, else the first. Null: the file has none.
  [[nodiscard]] const Json* shown_scene() const {
    const Json& scenes = file_.items("scenes");
    const int shown = index_member(file_.json.get(), "scene");
    if (scenes.empty()) return nullptr;
    return in_range(shown, scenes) ? &item_of(scenes, shown) : &scenes[0];
  }

  // That scene's nodes; without a scene, every node that is nobody's child.
  [[nodiscard]] std::vector<int> roots() const {
    if (const Json* scene = shown_scene()) return indices_member(scene, "nodes");
    std::vector<bool> is_child(file_.nodes.size(), false);
    for (const GltfNode& node : file_.nodes)
      for (const int child : node.children)
        if (in_range(child, is_child)) is_child[child] = true;
    std::vector<int> found;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) found.push_back(as_int(i));
    return found;
  }

  Expected<void> add(const GltfNode& node, const glm::mat4& world) {
    if (node.mesh >= 0 && node.visible) {
      const auto default_material = as_uint32(mesh_.materials.size() - 1);
      Expected<std::vector<glm::mat4>> instances = instances_of(node);
      if (!instances) return Unexpected(instances.error());
      if (node.skin >= 0 && !in_range(node.skin, file_.skins))
        return file_.error("a node names skin " + which_of(node.skin, file_.skins));
      DeformationReader deformation(file_, node, tree_.nodes.back().first_vertex, loading_.warnings);
      for (const glm::mat4& instance : *instances) {
        const std::size_t first = mesh_.positions.size(), first_triangle = mesh_.triangles.size();
        const Expected<void> added =
            add_gltf_mesh(file_, node.mesh, world * instance, default_material, mesh_, rest_,
                          deformation.needed() ? &deformation : nullptr, loading_);
        if (!added) return added;
        deformation.place(instance, as_uint32(first), std::span(rest_.normals).subspan(first));
        if (instance != glm::mat4(1.0f)) place_rest(Placement(instance), first);
        if (!deformation.needed()) add_copy(node.mesh, instance, first, first_triangle);
      }
      if (deformation.needed()) add_deformation(node, deformation);
    }
    if (in_range(node.camera, file_.items("cameras")))
      add_camera(item_of(file_.items("cameras"), node.camera), node, world);
    const Json* const light = member(extension(node.json, "KHR_lights_punctual"), "light");
    if (!light || !node.visible) return {};
    const Json& lights = array_member(extension(file_.json.get(), "KHR_lights_punctual"), "lights");
    if (!in_range(index_of(*light), lights))
      return file_.error("a node names a light that does not exist, there are " +
                         std::to_string(lights.size()));
    add_light(item_of(lights, index_of(*light)), node, world);
    return {};
  }

  void add_camera(const Json& json, const GltfNode& node, const glm::mat4& world) {
    const Camera camera = camera_of(json, node, world);
    const std::string type = text_member(&json, "type");
    if (type != "perspective" && type != "orthographic") {
      warn("camera '" + camera.name + "'", "is neither perspective nor orthographic and left out",
           "it cannot be chosen");
    } else if (const Expected<void> checked = check_camera(camera); !checked) {
      warn("camera '" + camera.name + "'", "is left out, as " + checked.error().what, "it cannot be chosen");
    } else {
      scene_.cameras.push_back(camera);
    }
  }

  void add_light(const Json& json, const GltfNode& node, const glm::mat4& world) {
    Light light = light_of(json, node, world);
    const std::string where = "light '" + light.name + "'";
    if (std::min({light.intensity, light.color.r, light.color.g, light.color.b}) < 0.0f) {
      warn(where, "has a negative intensity or colour", "negative values are read as 0");
      light.intensity = std::max(light.intensity, 0.0f);
      light.color = glm::max(light.color, 0.0f);
    }
    if (!is_light_type(text_member(&json, "type")))
      warn(where, "its type is not one of glTF's", "it is drawn as a point light");
    if (can_shine(light)) {
      scene_.lights.push_back(light);
    } else {
      warn(where, "has numbers that are not finite and is left out", "its light is missing");
    }
  }

  // All that was placed since.
  void add_copy(int mesh, const glm::mat4& node_from_mesh, std::size_t vertex, std::size_t triangle) {
    const auto vertices = as_uint32(mesh_.positions.size() - vertex);
    const auto triangles = as_uint32(mesh_.triangles.size() - triangle);
    if (triangles == 0) return;
    rest_.copies.push_back({as_int(tree_.nodes.size()) - 1, mesh, as_uint32(vertex), vertices,
                            as_uint32(triangle), triangles, node_from_mesh});
  }

  // A mesh that was placed once has no copies.
  void drop_single_copies() {
    std::map<int, int> placings;
    for (const MeshCopy& copy : rest_.copies) ++placings[copy.mesh];
    std::erase_if(rest_.copies, [&](const MeshCopy& copy) { return placings[copy.mesh] == 1; });
  }

  // The deformation is applied once all nodes are known, in add_skins.
  void add_deformation(const GltfNode& node, DeformationReader& reader) {
    rest_.deformations.push_back(reader.result());
    rest_.deformations.back().node = as_int(tree_.nodes.size()) - 1;
    rest_.deformations.back().skin = reader.skinned() ? node.skin : -1;  // the file's index until add_skins
    tree_.weights.push_back(reader.weights());
  }

  // Reads the skins that deformations use, and applies weights and skins to the mesh.
  Expected<void> add_skins() {
    std::map<int, int> skins;  // index in rest_.skins by the file's
    for (Deformation& deformation : rest_.deformations) {
      if (deformation.skin < 0) continue;
      const auto [at, is_new] = skins.try_emplace(deformation.skin, -1);
      if (is_new) {
        Expected<std::optional<Skin>> skin = gltf_skin(file_, at->first, place_of_node_);
        if (!skin) return Unexpected(skin.error());
        if (*skin) {
          at->second = as_int(rest_.skins.size());
          rest_.skins.push_back(std::move(**skin));
        } else {
          warn("skin " + std::to_string(at->first), "skins of joints that are not in the scene are left out",
               "what they cover moves with its node alone");
        }
      }
      deformation.skin = at->second;
    }
    tree_.rest = std::make_shared<const RestPose>(std::move(rest_));
    const std::vector<glm::mat4> world = world_matrices(tree_.nodes);
    for (std::size_t d = 0; d < tree_.weights.size(); ++d) {
      const Deformation& deformation = tree_.rest->deformations[d];
      const bool weighs = std::ranges::any_of(tree_.weights[d], [](float w) { return w != 0.0f; });
      if (deformation.skin < 0 && !weighs) continue;  // nothing deforms it
      const Node& node = tree_.nodes[deformation.node];
      const Deformer deformer(tree_, d, world);
      deformer.place(mesh_);
      if (deformer.mirrors() != Placement(world[deformation.node]).mirrors()) turn_around(node, mesh_);
    }
    return {};
  }

  // The rest pose of an instance is in its node's space.
  void place_rest(const Placement& instance, std::size_t first) {
    for (std::size_t i = first; i < rest_.positions.size(); ++i) {
      rest_.positions[i] = instance.position(rest_.positions[i]);
      rest_.normals[i] = instance.normal(rest_.normals[i]);
      if (!rest_.tangents.empty()) rest_.tangents[i] = instance.tangent(rest_.tangents[i]);
    }
  }

  // Where EXT_mesh_gpu_instancing places copies of the node's mesh; without it, one in place.
  [[nodiscard]] Expected<std::vector<glm::mat4>> instances_of(const GltfNode& node) const {
    const Json* attributes = member(extension(node.json, "EXT_mesh_gpu_instancing"), "attributes");
    if (!attributes) return std::vector{glm::mat4(1.0f)};
    std::vector<float> values[3];
    std::size_t count = 0;
    constexpr struct {
      const char* name;
      int components;
    } kAttributes[] = {{"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}};
    for (int i = 0; i < 3; ++i) {
      if (!member(attributes, kAttributes[i].name)) continue;
      Expected<std::vector<float>> read =
          file_.floats(index_member(attributes, kAttributes[i].name), kAttributes[i].components);
      if (!read) return Unexpected(read.error());
      const std::size_t elements = read->size() / kAttributes[i].components;
      if (count != 0 && elements != count)
        return file_.error("a node's instances have attributes of different lengths");
      count = elements;
      values[i] = std::move(*read);
    }
    std::vector<glm::mat4> instances;
    const auto& [translations, rotations, scales] = values;
    for (std::size_t i = 0; i < count; ++i) {
      NodeMotion motion;
      if (!translations.empty()) motion.translation = glm::make_vec3(&translations[3 * i]);
      if (const float* r = rotations.empty() ? nullptr : &rotations[4 * i])
        motion.rotation = glm::dquat(r[3], r[0], r[1], r[2]);
      if (!scales.empty()) motion.scale = glm::make_vec3(&scales[3 * i]);
      instances.push_back(motion.matrix());
    }
    return instances;
  }

  void warn(const std::string& where, const std::string& what, const std::string& lost) {
    loading_.warnings.add({file_.path.string(), where, what, lost});
  }

  void finish() {
    scene_.source_files = file_.named_files;
    scene_.variants = gltf_variants(*file_.json);
    add_gltf_textures(file_, mesh_, loading_);
    drop_unused_attributes(mesh_, rest_);
    drop_single_copies();
    if (const Json* scene = shown_scene()) {
      scene_.ambient_light =
          value_member<glm::vec3>(our_extras(scene), "ambient").value_or(scene_.ambient_light);
      scene_.environment = gltf_environment(file_, *scene, loading_);
    }
    const auto last = as_uint32(mesh_.materials.size() - 1);
    if (std::find(mesh_.triangle_materials.begin(), mesh_.triangle_materials.end(), last) ==
            mesh_.triangle_materials.end() &&
        last > 0)
      mesh_.materials.pop_back();  // no triangle has the default
  }

  const GltfFile& file_;
  Loading& loading_;
  Scene scene_;
  MeshData mesh_;
  NodeTree tree_;
  RestPose rest_;
  std::vector<int> place_of_node_ = std::vector<int>(file_.nodes.size(), -1);  // in tree_, by the file's
  std::size_t lights_before_ = 0, cameras_before_ = 0;
};

Expected<Scene> load_gltf(const std::filesystem::path& path, Loading& loading) {
  const Expected<GltfFile> file = read_gltf_file(path, loading);
  if (!file) return Unexpected(file.error());
  return SceneReader(*file, loading).read();
}

}  // namespace

namespace room {
extern const SceneFormat gltf{"glTF", {".gltf", ".glb"}, load_gltf, save_gltf, gltf_files};
}  // namespace room

}  // namespace pinocchio
