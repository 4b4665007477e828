#include <algorithm>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/image/atomic_file.h"
#include "core/scene/save_gltf_materials.h"
#include "pinocchio/save.h"

namespace pinocchio {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kUnsignedInt = 5125, kFloat = 5126;  // glTF's component types

// A rotation whose -Z is `forward`.
Json aimed_matrix(const glm::vec3& position, const glm::vec3& right, const glm::vec3& up,
                  const glm::vec3& forward) {
  const glm::mat4 m(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(-forward, 0), glm::vec4(position, 1));
  return std::vector<float>(glm::value_ptr(m), glm::value_ptr(m) + 16);
}

class GltfWriter {
 public:
  GltfWriter(const Scene& scene, const std::filesystem::path& file, Warnings& warnings) : mesh_(*scene.mesh) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Pinocchio"}};
    json_["scene"] = 0;
    json_["scenes"] =
        Json::array({{{"nodes", Json::array()},
                      {"extras", {{"pinocchio", {{"ambient", color_json(scene.ambient_light)}}}}}}});
    add_materials(file, warnings);
    add_mesh();
    for (const Camera& camera : scene.cameras) add_camera(camera);
    for (const Light& light : scene.lights) add_light(light);
    for (const std::string& name : extensions_) json_["extensionsUsed"].push_back(name);
  }

  // The JSON with its buffer's place filled in.
  Json finish(const std::string& buffer_uri) {
    Json buffer{{"byteLength", binary_.size()}};
    if (!buffer_uri.empty()) buffer["uri"] = buffer_uri;
    json_["buffers"] = Json::array({buffer});
    return json_;
  }
  [[nodiscard]] const std::string& binary() const { return binary_; }

 private:
  void add_node(Json node) {
    json_["scenes"][0]["nodes"].push_back(json_["nodes"].size());
    json_["nodes"].push_back(std::move(node));
  }

  int add_view(std::string_view bytes) {
    binary_.append((4 - binary_.size() % 4) % 4, '\0');  // numbers lie where they may
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    binary_.append(bytes);
    return static_cast<int>(json_["bufferViews"].size()) - 1;
  }

  template <class T>
  int add_accessor(const std::vector<T>& elements, int component_type, const char* type) {
    const int view = add_view({reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(T)});
    json_["accessors"].push_back({{"bufferView", view},
                                  {"componentType", component_type},
                                  {"count", elements.size()},
                                  {"type", type}});
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  void add_materials(const std::filesystem::path& file, Warnings& warnings) {
    GltfMaterialWriter writer(mesh_, [this](const std::string& bytes) { return add_view(bytes); }, file, warnings);
    Json materials = Json::array();
    for (const Material& m : mesh_.materials) materials.push_back(writer.material(m));
    json_["materials"] = std::move(materials);
    writer.finish(json_);
    extensions_.insert(extensions_.end(), writer.extensions().begin(), writer.extensions().end());
  }

  // Runs of triangles of one material are primitives over the same vertices: the order of triangles stays.
  void add_mesh() {
    Json attributes{{"POSITION", add_accessor(mesh_.positions, kFloat, "VEC3")}};
    const Bounds b = all_positions();
    json_["accessors"].back()["min"] = vec3_json(b.lo);  // the specification wants them of positions
    json_["accessors"].back()["max"] = vec3_json(b.hi);
    const auto given = [](const glm::vec3& n) { return n != glm::vec3(0.0f); };
    if (std::any_of(mesh_.normals.begin(), mesh_.normals.end(), given))
      attributes["NORMAL"] = add_accessor(mesh_.normals, kFloat, "VEC3");
    Json primitives = Json::array();
    const Optional optional = optional_attributes();
    for (std::size_t first = 0; first < mesh_.triangles.size();) {
      const std::uint32_t material = mesh_.triangle_materials[first];
      std::size_t end = first;
      while (end < mesh_.triangles.size() && mesh_.triangle_materials[end] == material) ++end;
      std::vector<std::uint32_t> indices;
      for (std::size_t i = first; i < end; ++i)
        for (int c = 0; c < 3; ++c) indices.push_back(mesh_.triangles[i][c]);
      Json own = attributes;
      add_optional(optional, mesh_.maps_of(static_cast<std::uint32_t>(first)), indices, own);
      primitives.push_back({{"attributes", own},
                            {"indices", add_accessor(indices, kUnsignedInt, "SCALAR")},
                            {"material", material}});
      first = end;
    }
    json_["meshes"] = Json::array({{{"primitives", primitives}}});
    add_node({{"mesh", 0}});
  }

  // Accessors of what only some materials look up; -1: the mesh has none.
  struct Optional {
    int texcoord = -1, texcoord1 = -1, color = -1, tangent = -1;
  };
  Optional optional_attributes() {
    Optional result;
    if (!mesh_.texcoords.empty()) result.texcoord = add_accessor(mesh_.texcoords, kFloat, "VEC2");
    if (!mesh_.texcoords1.empty()) result.texcoord1 = add_accessor(mesh_.texcoords1, kFloat, "VEC2");
    if (!mesh_.colors.empty()) result.color = add_accessor(mesh_.colors, kFloat, "VEC4");
    if (!mesh_.tangents.empty()) result.tangent = add_accessor(mesh_.tangents, kFloat, "VEC4");
    return result;
  }

  void add_optional(const Optional& optional, const MaterialMaps* maps, const std::vector<std::uint32_t>& indices, Json& to) const {
    if (!maps) return;
    if (optional.texcoord >= 0) to["TEXCOORD_0"] = optional.texcoord;
    if (optional.texcoord1 >= 0) {
      to["TEXCOORD_1"] = optional.texcoord1;
      if (optional.texcoord < 0) to["TEXCOORD_0"] = optional.texcoord1;  // glTF counts them from 0
    }
    if (optional.color >= 0 && maps->vertex_colors) to["COLOR_0"] = optional.color;
    const auto given = [this](std::uint32_t vertex) { return mesh_.tangents[vertex].w != 0.0f; };
    if (optional.tangent >= 0 && maps->normal.used() && std::all_of(indices.begin(), indices.end(), given))
      to["TANGENT"] = optional.tangent;
  }

  [[nodiscard]] Bounds all_positions() const {
    Bounds b;
    for (const glm::vec3& p : mesh_.positions) b.add(p);
    return b;
  }

  void add_camera(const Camera& camera) {
    const CameraAxes axes = camera_axes(camera);
    Json ours{{"target", vec3_json(camera.target)}, {"up", vec3_json(camera.up)}};
    if (camera.lens_radius > 0.0f) ours["lensRadius"] = camera.lens_radius;
    if (camera.focus_distance > 0.0f) ours["focusDistance"] = camera.focus_distance;
    add_node(
        {{"name", camera.name},
         {"camera", json_["cameras"].size()},
         {"matrix", aimed_matrix(camera.eye, axes.right, axes.up, axes.forward)},
         {"extras", {{"pinocchio", ours}}}});
    const double yfov = glm::radians(static_cast<double>(camera.fov_deg));
    json_["cameras"].push_back({{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 0.01}}}});
  }

  void add_light(const Light& light) {
    Json& lights = json_["extensions"]["KHR_lights_punctual"]["lights"];
    if (lights.empty()) extensions_.emplace_back("KHR_lights_punctual");
    constexpr const char* kTypes[] = {"point", "directional", "spot", "point"};  // a rectangle: where none is known
    Json json{{"name", light.name},
              {"type", kTypes[static_cast<int>(light.kind)]},
              {"color", vec3_json(light.color)},
              {"intensity", light.intensity}};
    if (std::isfinite(light.range)) json["range"] = light.range;
    if (light.kind == Light::Kind::spot)
      json["spot"] = {{"innerConeAngle", std::acos(light.cos_inner)},
                      {"outerConeAngle", std::acos(light.cos_outer)}};
    Json ours = Json::object();
    if (!light.casts_shadow) ours["castsShadow"] = false;
    if (light.kind != Light::Kind::directional && light.falloff == Light::Falloff::none)
      ours["falloff"] = "none";
    if (light.radius > 0.0f) ours["radius"] = light.radius;
    if (light.angle_deg > 0.0f) ours["angle"] = light.angle_deg;
    CameraAxes axes = camera_axes({{}, light.position, light.position + light.direction, {0, 1, 0}, 0});
    if (light.kind == Light::Kind::rectangle) {
      const float u = glm::length(light.edge_u), v = glm::length(light.edge_v);
      ours["rectangle"] = {u, v};
      if (u > 0.0f && v > 0.0f) axes = {light.edge_u / u, light.edge_v / v, light.direction};
    }
    if (!ours.empty()) json["extras"]["pinocchio"] = ours;

    Json node{{"name", light.name}, {"extensions", {{"KHR_lights_punctual", {{"light", lights.size()}}}}}};
    if (light.kind == Light::Kind::point) {
      node["translation"] = vec3_json(light.position);
    } else {
      node["matrix"] = aimed_matrix(light.position, axes.right, axes.up, axes.forward);
    }
    lights.push_back(json);
    add_node(node);
  }

  const Mesh& mesh_;
  Json json_;
  std::string binary_;
  std::vector<std::string> extensions_;
};

// Names that are not UTF-8 (an old OBJ's) lose what JSON cannot say.
std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

void append_u32(std::string& to, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  to.append(reinterpret_cast<const char*>(&word), sizeof word);
}

void append_chunk(std::string& to, const char* type, std::string data, char padding) {
  while (data.size() % 4 != 0) data += padding;
  append_u32(to, data.size());
  to.append(type, 4);
  to += data;
}

std::string glb_of(GltfWriter& writer) {
  std::string chunks;
  append_chunk(chunks, "JSON", text_of(writer.finish(""), -1), ' ');
  append_chunk(chunks, "BIN\0", writer.binary(), '\0');
  std::string glb = "glTF";
  append_u32(glb, 2);  // version
  append_u32(glb, chunks.size() + 12);
  return glb + chunks;
}

}  // namespace

void save_gltf(const Scene& scene, const std::filesystem::path& file, Progress* progress, Warnings* warnings) {
  throw_if_cancelled(progress);
  Warnings unheard;
  GltfWriter writer(scene, file, warnings ? *warnings : unheard);
  if (file.extension() == ".glb") {
    write_text(file, glb_of(writer), progress);
    return;
  }
  std::filesystem::path binary = file;
  binary.replace_extension(".bin");
  check_writable(binary);
  const std::string json = text_of(writer.finish(binary.filename().string()), 1) + "\n";
  // Both are whole before either gets its name.
  write_text(file, json, nullptr, [&] { write_text(binary, writer.binary(), progress); });
}

}  // namespace pinocchio
