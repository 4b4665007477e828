#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/files/atomic_file.h"
#include "core/scene/formats.h"
#include "core/scene/gltf/format/glb_size.h"
#include "core/scene/gltf/save/materials.h"
#include "core/scene/gltf/save/mesh.h"
#include "core/scene/gltf/save/motion.h"
#include "core/scene/pose/pose.h"
#include "pinocchio/animation.h"
#include "pinocchio/conversion.h"
#include "pinocchio/error.h"
#include "pinocchio/save.h"

namespace pinocchio {
namespace {

using Json = nlohmann::ordered_json;

// A rotation whose -Z is `forward`.
Json aimed_matrix(const glm::vec3& position, const glm::vec3& right, const glm::vec3& up,
                  const glm::vec3& forward) {
  const glm::mat4 m(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(-forward, 0), glm::vec4(position, 1));
  return std::vector<float>(glm::value_ptr(m), glm::value_ptr(m) + 16);
}

bool near(const glm::vec3& a, const glm::vec3& b) {
  return glm::length(a - b) <= 1e-4f * (glm::length(a) + glm::length(b));
}

bool same_place(const Light& a, const Light& b) {
  return near(a.position, b.position) && near(a.direction, b.direction) && near(a.edge_u, b.edge_u) &&
         near(a.edge_v, b.edge_v);
}
bool same_place(const Camera& a, const Camera& b) {
  return near(a.eye, b.eye) && near(a.target, b.target) && near(a.up, b.up);
}

void copy_place(const Light& from, Light& to) {
  to.position = from.position, to.direction = from.direction;
  to.edge_u = from.edge_u, to.edge_v = from.edge_v;
}
void copy_place(const Camera& from, Camera& to) {
  to.eye = from.eye, to.target = from.target, to.up = from.up;
}

// The light or camera as its node sees it: where it rests, or, if it was moved by itself since, where that is
// from the node now.
template <class T>
T as_node_sees(const Attached<T>& attached, const T& item, const glm::mat4& now) {
  T at_rest = item, with_node = item;
  place(Placement(now), attached.at_rest, with_node);
  if (same_place(with_node, item) || glm::determinant(glm::mat3(now)) == 0.0f)
    copy_place(attached.at_rest, at_rest);
  else
    place(Placement(glm::inverse(now)), item, at_rest);
  return at_rest;
}

// Which of a scene's lights or cameras hang on a node, and the first that does.
struct Hung {
  std::vector<bool> hangs;
  std::size_t first;

  Hung(const std::vector<std::size_t>& places, std::size_t all) : hangs(all, false), first(all) {
    for (const std::size_t place : places) {
      if (place == kGone) continue;
      hangs[place] = true;
      first = std::min(first, place);
    }
    if (first == all) first = 0;  // none hangs
  }
};

class GltfWriter {
 public:
  GltfWriter(const Scene& scene, const std::filesystem::path& file, Warnings& warnings) : scene_(scene) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Pinocchio"}};
    json_["scene"] = 0;
    json_["scenes"] =
        Json::array({{{"nodes", Json::array()},
                      {"extras", {{"pinocchio", {{"ambient", color_json(scene.ambient_light)}}}}}}});
    add_materials(file, warnings);
    if (can_save_motion(scene)) {
      add_moving();
    } else {
      if (scene.animation)
        warnings.add({file.string(), "", "animations are left out", "everything stands still"});
      add_mesh();
      for (const Camera& camera : scene.cameras) data_.add_node(camera_node(camera, camera));
      for (const Light& light : scene.lights) data_.add_node(light_node(light));
    }
    for (const std::string& name : extensions_) json_["extensionsUsed"].push_back(name);
  }

  // The JSON with its buffer's place filled in.
  Json finish(const std::string& buffer_uri) {
    Json buffer{{"byteLength", data_.binary.size()}};
    if (!buffer_uri.empty()) buffer["uri"] = buffer_uri;
    json_["buffers"] = Json::array({buffer});
    return json_;
  }
  [[nodiscard]] const std::string& binary() const { return data_.binary; }

 private:
  void add_materials(const std::filesystem::path& file, Warnings& warnings) {
    const Mesh& mesh = *scene_.mesh;
    GltfMaterialWriter writer(
        mesh, [this](const std::string& bytes) { return data_.add_view(bytes); }, file, warnings);
    Json materials = Json::array();
    for (const Material& m : mesh.materials) materials.push_back(writer.material(m));
    json_["materials"] = std::move(materials);
    writer.finish(json_);
    extensions_.insert(extensions_.end(), writer.extensions().begin(), writer.extensions().end());
  }

  // All of it in the world, on one node.
  void add_mesh() {
    const Mesh& mesh = *scene_.mesh;
    const SavedPart all{0, 0, as_uint32(mesh.triangles.size()), mesh.positions, mesh.normals, mesh.tangents};
    json_["meshes"] = Json::array({{{"primitives", gltf_primitives(mesh, all, Json::object(), data_)}}});
    data_.add_node({{"mesh", 0}});
  }

  // Nodes as they rest; lights and cameras that move with one are its first children, in their order.
  void add_moving() {
    const std::vector<int> place = add_moving_nodes(scene_, data_);
    const RestPose& rest = *scene_.nodes->rest;
    const auto hang = [&](int node, Json json) {
      const int index = data_.add_node(std::move(json), false);
      Json& children = json_["nodes"][as_size(place[node])]["children"];
      if (children.is_null()) children = Json::array();
      children.insert(children.begin(), index);
    };
    const std::vector<glm::mat4> world = world_at_rest(scene_), now = world_matrices(scene_.nodes->nodes);
    const AttachedPlaces places = attached_places(rest, scene_);
    Hung cameras(places.cameras, scene_.cameras.size()), lights(places.lights, scene_.lights.size());
    std::vector<int> first;  // free ones in front of those that hang, in their order
    const auto add_free = [&](const Hung& hung, std::size_t i, Json json) {
      const bool in_front = i < hung.first;
      const int index = data_.add_node(std::move(json), !in_front);
      if (in_front) first.push_back(index);
    };
    for (std::size_t a = rest.cameras.size(); a-- > 0;) {
      if (places.cameras[a] == kGone) continue;
      const auto n = as_size(rest.cameras[a].node);
      const Camera camera = as_node_sees(rest.cameras[a], scene_.cameras[places.cameras[a]], now[n]);
      Camera in_world = scene_.cameras[places.cameras[a]];
      if (const Placement placement(world[n]); world[n] != now[n]) {
        in_world.target = placement.position(camera.target);
        in_world.up = placement.direction(camera.up);
      }
      hang(rest.cameras[a].node, camera_node(camera, in_world));
    }
    for (std::size_t i = 0; i < scene_.cameras.size(); ++i)
      if (!cameras.hangs[i]) add_free(cameras, i, camera_node(scene_.cameras[i], scene_.cameras[i]));
    for (std::size_t a = rest.lights.size(); a-- > 0;)
      if (places.lights[a] != kGone)
        hang(rest.lights[a].node, light_node(as_node_sees(rest.lights[a], scene_.lights[places.lights[a]],
                                                          now[rest.lights[a].node])));
    for (std::size_t i = 0; i < scene_.lights.size(); ++i)
      if (!lights.hangs[i]) add_free(lights, i, light_node(scene_.lights[i]));
    Json& roots = json_["scenes"][0]["nodes"];
    for (auto index = first.rbegin(); index != first.rend(); ++index) roots.insert(roots.begin(), *index);
    add_skins_and_animation(scene_, place, data_);
  }

  // glTF has perspective and orthographic cameras; xmag and zfar are for viewers that need them.
  static Json optics_of(const Camera& camera) {
    if (camera.projection == Projection::orthographic)
      return {
          {"type", "orthographic"},
          {"orthographic",
           {{"xmag", 0.5 * camera.height}, {"ymag", 0.5 * camera.height}, {"znear", 0.0}, {"zfar", 1e6}}}};
    const double yfov = glm::radians(as_double(camera.fov_deg));
    return {{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 0.01}}}};
  }

  // As its node's parent sees it, with its target and up, which our extras have as the world sees them.
  Json camera_node(const Camera& camera, const Camera& in_world) {
    const CameraAxes axes = camera_axes(camera);
    Json ours{{"target", vec3_json(in_world.target)}, {"up", vec3_json(in_world.up)}};
    if (camera.lens_radius > 0.0f) ours["lensRadius"] = camera.lens_radius;
    if (camera.focus_distance > 0.0f) ours["focusDistance"] = camera.focus_distance;
    const std::size_t index = json_["cameras"].size();
    json_["cameras"].push_back(optics_of(camera));
    return {{"name", camera.name},
            {"camera", index},
            {"matrix", aimed_matrix(camera.eye, axes.right, axes.up, axes.forward)},
            {"extras", {{"pinocchio", ours}}}};
  }

  Json light_node(const Light& light) {
    Json& lights = json_["extensions"]["KHR_lights_punctual"]["lights"];
    if (lights.empty()) extensions_.emplace_back("KHR_lights_punctual");
    const LightKind& kind = kind_of(light);
    Json json{{"name", light.name},
              {"type", kind.gltf_type},
              {"color", vec3_json(light.color)},
              {"intensity", light.intensity}};
    if (std::isfinite(light.range)) json["range"] = light.range;
    if (kind.has_cone)
      json["spot"] = {{"innerConeAngle", std::acos(light.cos_inner)},
                      {"outerConeAngle", std::acos(light.cos_outer)}};
    Json ours = Json::object();
    if (!light.casts_shadow) ours["castsShadow"] = false;
    if (kind.has_position && light.falloff == Light::Falloff::none) ours["falloff"] = "none";
    for (const LightSize& size : kLightSizes)
      if (light.*size.value > 0.0f) ours[std::string(size.name)] = light.*size.value;
    CameraAxes axes = camera_axes({{}, light.position, light.position + light.direction, {0, 1, 0}, 0});
    if (kind.has_sides) {
      const float u = glm::length(light.edge_u), v = glm::length(light.edge_v);
      ours[std::string(kind.name)] = {u, v};
      if (u > 0.0f && v > 0.0f) axes = {light.edge_u / u, light.edge_v / v, light.direction};
    }
    if (!ours.empty()) json["extras"]["pinocchio"] = ours;

    Json node{{"name", light.name}, {"extensions", {{"KHR_lights_punctual", {{"light", lights.size()}}}}}};
    if (kind.has_direction)
      node["matrix"] = aimed_matrix(light.position, axes.right, axes.up, axes.forward);
    else
      node["translation"] = vec3_json(light.position);
    lights.push_back(json);
    return node;
  }

  const Scene& scene_;
  GltfData data_;
  Json& json_ = data_.json;
  std::vector<std::string> extensions_;
};

// Names that are not UTF-8 (an old OBJ's) lose what JSON cannot say.
std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

void append_u32(std::string& to, std::size_t value) {
  const auto word = as_uint32(value);
  to.append(reinterpret_cast<const char*>(&word), sizeof word);
}

void append_chunk(std::string& to, const char* type, const std::string& data, char padding) {
  const std::size_t bytes = padded_to_words(data.size());
  append_u32(to, bytes);
  to.append(type, 4);
  to += data;
  to.append(bytes - data.size(), padding);
}

std::filesystem::path binary_file(std::filesystem::path file) {
  return file.replace_extension(".bin");
}

std::string glb_of(GltfWriter& writer, const std::filesystem::path& file) {
  const std::string json = text_of(writer.finish(""), -1);
  const std::optional<std::uint64_t> bytes = glb_bytes(json.size(), writer.binary().size());
  if (!bytes)
    throw EnvironmentError(file.string() + ": would hold " +
                           std::to_string(json.size() + writer.binary().size()) +
                           " bytes, a .glb may have 4294967295; choose .gltf, whose .bin may be larger");
  std::string glb = "glTF";
  glb.reserve(*bytes);
  append_u32(glb, 2);  // version
  append_u32(glb, *bytes);
  append_chunk(glb, "JSON", json, ' ');
  append_chunk(glb, "BIN\0", writer.binary(), '\0');
  return glb;
}

}  // namespace

void save_gltf(const Scene& scene, const std::filesystem::path& file, Progress* progress,
               Warnings* warnings) {
  throw_if_cancelled(progress);
  Warnings unheard;
  GltfWriter writer(scene, file, warnings ? *warnings : unheard);
  if (lower_extension(file) == ".glb") {
    write_text(file, glb_of(writer, file), progress);
    return;
  }
  const std::filesystem::path binary = binary_file(file);
  check_writable(binary);
  const std::string json = text_of(writer.finish(binary.filename().string()), 1) + "\n";
  // Both are whole before either gets its name.
  write_text(file, json, nullptr, [&] { write_text(binary, writer.binary(), progress); });
}

SavedFiles gltf_files(const Scene&, const std::filesystem::path& file) {
  if (lower_extension(file) == ".glb") return {file};
  return {file, binary_file(file)};
}

}  // namespace pinocchio
