// A small glTF to bend.
#pragma once

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/own_file.h"
#include "tests/support/scenes.h"

namespace pinocchio {

using Json = nlohmann::json;

// A glTF of one triangle (0,0,0) (1,0,0) (0,1,0), its buffer in a file beside it.
inline Json triangle_json() {
  const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::vector<std::uint16_t> indices{0, 1, 2, 3};
  std::ofstream out(own_file("test.bin"), std::ios::binary);
  out.write(reinterpret_cast<const char*>(positions.data()), 48);
  out.write(reinterpret_cast<const char*>(indices.data()), 8);
  return Json::parse(R"({
    "asset": {"version": "2.0"},
    "buffers": [{"uri": "test.bin", "byteLength": 56}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 8}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "nodes": [{"mesh": 0}],
    "scenes": [{"nodes": [0]}],
    "scene": 0
  })");
}

inline Expected<Scene> load(const Json& json, Warnings* warnings = nullptr) {
  const std::filesystem::path path = own_file("test.gltf");
  std::ofstream(path) << json.dump();
  return load_scene(path, warnings);
}

inline Scene load_good(const Json& json) {
  Expected<Scene> scene = load(json);
  EXPECT_TRUE(scene) << scene.error().message();
  return scene ? std::move(*scene) : Scene{};
}

inline std::string error_of(const Json& json) {
  const Expected<Scene> scene = load(json);
  EXPECT_FALSE(scene);
  return scene ? "" : scene.error().message();
}

// A material whose base colour is image 0 of the file.
inline Json textured_json(const Json& image) {
  Json json = triangle_json();
  json["images"] = {image};
  json["textures"] = {{{"source", 0}}};
  json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  return json;
}

// The same, with texture coordinates: one attribute more, and its accessor.
inline Json with_coordinates(Json json) {
  Json& accessors = json["accessors"];
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = accessors.size();
  accessors.push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  return json;
}

inline std::string base64(const std::string& bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(i + k > bytes.size() ? '=' : kLetters[bits >> (18 - 6 * k) & 63]);
  }
  return text;
}

}  // namespace pinocchio
