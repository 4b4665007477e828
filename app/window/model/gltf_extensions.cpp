#include "app/window/model/gltf_extensions.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/scene/formats.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

constexpr std::size_t kMost_bytes = std::size_t{256} << 20;  // of JSON

// The JSON of a .gltf, or that of a .glb, which has it first.
std::string json_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code unknown;
  std::uintmax_t length = std::filesystem::file_size(file, unknown);
  if (lower_extension(file) == ".glb") {
    std::array<unsigned char, 20> header{};
    in.read(reinterpret_cast<char*>(header.data()), header.size());
    length = header[12] | header[13] << 8 | header[14] << 16 | as_uint32(header[15]) << 24;
  }
  if (unknown || !in || length > kMost_bytes) return {};
  std::string text(length, ' ');
  in.read(text.data(), static_cast<std::streamsize>(length));
  return in ? text : std::string();
}

}  // namespace

std::vector<std::string> gltf_extensions(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  if (extension != ".gltf" && extension != ".glb") return {};
  // The rest is dropped while it is read.
  const auto is_wanted = [](int depth, nlohmann::json::parse_event_t event, const nlohmann::json& parsed) {
    return event != nlohmann::json::parse_event_t::key || depth > 1 || parsed == "extensionsUsed";
  };
  const nlohmann::json json = nlohmann::json::parse(json_of(file), is_wanted, false);
  std::vector<std::string> names;
  const auto found = json.find("extensionsUsed");
  if (found == json.end() || !found->is_array()) return names;
  for (const nlohmann::json& name : *found)
    if (name.is_string()) names.push_back(name.get<std::string>());
  return names;
}

}  // namespace pinocchio::app
