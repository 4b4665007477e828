// The materials and textures that save_gltf writes.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/scene/gltf/format/material_table.h"
#include "pinocchio/load.h"

namespace pinocchio {

class GltfMaterialWriter {
 public:
  using Json = nlohmann::ordered_json;
  // `add_view` puts bytes into the file's buffer and returns their buffer view; warnings name `file`.
  GltfMaterialWriter(const Mesh& mesh, std::function<int(const std::string&)> add_view,
                     const std::filesystem::path& file, Warnings& warnings);

  [[nodiscard]] Json material(const Material& m);
  // The textures, samplers and images that the materials use.
  void finish(Json& gltf) const;
  [[nodiscard]] const std::set<std::string>& extensions() const { return extensions_; }

 private:
  void add_maps(const Material& m, const MaterialMaps& maps, Json& json);
  void add_surface(const Material& m, const GltfSurface& surface, Json& json);
  void add_emission(const glm::vec3& emission, Json& json);
  void add_extension(Json& json, const char* name, const Json& value);
  [[nodiscard]] Json texture(const TextureUse& use, int image);
  [[nodiscard]] int image_of(int texture);
  [[nodiscard]] int base_image(const Material& m, const MaterialMaps& maps);
  [[nodiscard]] int add_image(const Texture& texture);

  const Mesh& mesh_;
  std::function<int(const std::string&)> add_view_;
  std::string file_;
  Warnings& warnings_;
  std::map<int, int> images_of_textures_;
  Json textures_ = Json::array(), samplers_ = Json::array(), images_ = Json::array();
  std::set<std::string> extensions_;
};

}  // namespace pinocchio
