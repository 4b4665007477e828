#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/scene/gltf_buffers.h"
#include "core/scene/gltf_features.h"
#include "core/scene/input_file.h"

namespace pinocchio {
namespace {

constexpr std::string_view kBinaryMagic = "glTF";

// tinygltf recurses into extras and extensions; this many levels fit any stack.
constexpr int kDeepest = 256;
constexpr std::size_t kGreatest = 0x7fffffff;  // index that tinygltf holds

// JSON without its long data URIs: base64 of buffers and images, through which JSON libraries go byte by byte
// and copy them. kDataAside and their number in `data_uris` stands where they stood.
struct Outline {
  std::string json;
  std::vector<std::string_view> data_uris;
  bool too_deep = false;
};

Outline outline_of(std::string_view text) {
  constexpr std::size_t kLong = 1024;
  Outline outline;
  std::size_t taken = 0;  // of `text`, into outline.json
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') ++i;
    if (c == '"') in_string = !in_string;
    if (in_string && c == '"' && text.substr(i + 1).starts_with("data:")) {
      const std::string_view uri = text.substr(i + 1, text.find('"', i + 1) - (i + 1));
      if (uri.size() < kLong || uri.find('\\') != uri.npos) continue;
      outline.json.append(text.substr(taken, i + 1 - taken))
          .append(kDataAside)
          .append(std::to_string(outline.data_uris.size()));
      outline.data_uris.push_back(uri);
      i += uri.size();
      taken = i + 1;
    }
    if (in_string) continue;
    if ((c == '[' || c == '{') && ++depth > kDeepest) outline.too_deep = true;
    if (c == ']' || c == '}') --depth;
  }
  outline.json.append(text.substr(taken));
  return outline;
}

// A file's parts: its JSON, and a .glb's binary chunk.
struct Parts {
  FileBytes text;  // all of a .gltf; empty: they lie in GltfFile::storage
  std::string_view json;
  std::span<const unsigned char> binary;
};

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

constexpr std::size_t kChunkHeader = 8;
constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;

bool is_chunk(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < kChunkHeader) return false;
  const std::uint32_t type = number_at(bytes, at + 4);
  return type == kJson || type == kBinary;
}

Expected<Parts> split(GltfFile& file, FileBytes bytes, Warnings& warnings) {
  Parts parts;
  if (!bytes.text().starts_with(kBinaryMagic)) {
    parts.text = as_utf8(std::move(bytes));
    parts.json = parts.text.text();
    return parts;
  }
  const std::string_view kept = file.storage.emplace_back(std::move(bytes)).text();
  constexpr std::size_t kHeader = 12, kAlignment = 4;
  if (kept.size() < kHeader) return file.error("ends within its header", "is the export complete?");
  if (const std::uint32_t version = number_at(kept, 4); version != 2)
    return file.error("is binary glTF " + std::to_string(version) + ", only 2 can be read",
                      "convert it to glTF 2.0");
  const auto unaligned = [&] {
    warnings.add({file.path.string(), "", "its chunks are not padded to multiples of 4 bytes",
                  "nothing is lost, but other programs may not read it"});
  };
  // What follows the two chunks that are known is nobody's.
  for (std::size_t at = kHeader;
       at + kChunkHeader <= kept.size() && (parts.json.empty() || parts.binary.empty());) {
    std::size_t length = number_at(kept, at);
    const std::uint32_t type = number_at(kept, at + 4);
    at += kChunkHeader;
    if (length > kept.size() - at && length - (kept.size() - at) < kAlignment && type == kBinary) {
      length = kept.size() - at;  // the last chunk counts padding that is not there
      unaligned();
    }
    if (length > kept.size() - at)
      return file.error("ends within a chunk of " + std::to_string(length) + " bytes",
                        "is the export complete?");
    if (type == kJson && parts.json.empty()) parts.json = kept.substr(at, length);
    if (type == kBinary && parts.binary.empty())
      parts.binary = {reinterpret_cast<const unsigned char*>(kept.data()) + at, length};
    const std::size_t end = at + length, aligned = at + (length + kAlignment - 1) / kAlignment * kAlignment;
    const bool is_unaligned = !is_chunk(kept, aligned) && is_chunk(kept, end);
    if (is_unaligned) unaligned();
    at = is_unaligned ? end : aligned;
  }
  while (parts.json.ends_with('\0')) parts.json.remove_suffix(1);  // some pad with zeros
  return parts;
}

void put_draco_aside(nlohmann::json& extensions) {
  const auto draco =
      extensions.is_object() ? extensions.find("KHR_draco_mesh_compression") : extensions.end();
  if (draco == extensions.end()) return;
  nlohmann::json packed = std::move(*draco);
  extensions.erase(draco);
  extensions[kDracoAside] = std::move(packed);
}

// Takes out what tinygltf need not see: what is read by ourselves, and indices, of which it refuses those
// without a buffer view. The indices, primitive by primitive:
std::vector<int> reduce(nlohmann::json& gltf) {
  for (const char* key : {"buffers", "bufferViews", "images"}) gltf.erase(key);
  std::vector<int> indices;
  const auto meshes = gltf.find("meshes");
  if (meshes == gltf.end() || !meshes->is_array()) return indices;
  for (nlohmann::json& mesh : *meshes) {
    if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array()) continue;
    for (nlohmann::json& primitive : mesh["primitives"]) {
      const bool has = primitive.is_object() && primitive.contains("indices");
      const std::optional<std::size_t> accessor =
          has ? size_member(primitive, "indices") : std::optional<std::size_t>();
      indices.push_back(accessor ? static_cast<int>(std::min(*accessor, kGreatest)) : -1);
      if (has) primitive.erase("indices");
      if (primitive.is_object() && primitive.contains("extensions")) put_draco_aside(primitive["extensions"]);
    }
  }
  return indices;
}

// Parses what `reduce` left; false and an error, which tinygltf may leave empty.
bool parse_model(const nlohmann::json& gltf, tinygltf::Model& model, std::string& error) {
  const std::string text = gltf.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (text.size() > std::numeric_limits<unsigned>::max()) {
    error = "it holds " + std::to_string(text.size()) + " bytes of JSON, at most 4294967295 are read";
    return false;
  }
  tinygltf::TinyGLTF reader;
  std::string warning;
  bool read = false;
  try {
    read = reader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                      static_cast<unsigned>(text.size()), "");
  } catch (const std::exception& e) {  // of the JSON library below, on values of the wrong type
    error = e.what();
  }
  // Caught by tinygltf or above: the file is not at fault.
  if (!read && error.find("std::bad_alloc") != std::string::npos) throw std::bad_alloc();
  return read;
}

// Which of the file's arrays tinygltf refuses without a reason: the one without which it reads the rest.
std::string refused_array(const nlohmann::json& gltf) {
  for (const auto& [key, value] : gltf.items()) {
    if (!value.is_array()) continue;
    nlohmann::json rest = gltf;
    rest.erase(key);
    tinygltf::Model model;
    std::string error;
    if (parse_model(rest, model, error)) return "one of its " + key + " lacks a member that it has to have";
  }
  return "an object lacks a member that it has to have";
}

Expected<void> parse(GltfFile& file, nlohmann::json& gltf) {
  const std::vector<int> indices = reduce(gltf);
  tinygltf::Model model;
  std::string error;
  if (!parse_model(gltf, model, error)) {
    const std::string reason = error.substr(0, error.find('\n'));
    return file.error("is not glTF 2.0 that can be read: " + (reason.empty() ? refused_array(gltf) : reason),
                      "is the export complete?");
  }
  model.bufferViews = std::move(file.model.bufferViews);
  model.images = std::move(file.model.images);
  file.model = std::move(model);
  std::size_t next = 0;
  for (tinygltf::Mesh& mesh : file.model.meshes)
    for (tinygltf::Primitive& primitive : mesh.primitives)
      if (next < indices.size()) primitive.indices = indices[next++];
  for (tinygltf::Texture& texture : file.model.textures)
    if (const std::optional<float> webp =
            number_member(extension(texture.extensions, "EXT_texture_webp"), "source"))
      texture.source = *webp >= 0.0f && *webp < static_cast<float>(file.model.images.size())
                           ? static_cast<int>(*webp)
                           : -1;
  return {};
}

}  // namespace

Expected<GltfFile> read_gltf_file(const std::filesystem::path& path, Loading& loading) {
  GltfFile file;
  file.path = path;
  file.progress = loading.progress;
  file.limit = &loading.limit;
  file.files = &loading.files;
  Expected<FileBytes> bytes = read_input_file(path, loading.progress);
  if (!bytes) return Unexpected(bytes.error());
  Expected<Parts> parts = split(file, std::move(*bytes), loading.warnings);
  if (!parts) return Unexpected(parts.error());
  Outline outline = outline_of(parts->json);
  if (outline.too_deep) return file.error("is nested too deeply");
  file.data_uris = std::move(outline.data_uris);
  nlohmann::json gltf;
  try {
    gltf = nlohmann::json::parse(outline.json);
  } catch (const nlohmann::json::parse_error& e) {
    const auto end =
        outline.json.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, outline.json.size()));
    const bool encoding = std::string_view(e.what()).find("UTF-8") != std::string_view::npos;
    return Unexpected(
        InputError{path.string(), 1 + static_cast<int>(std::count(outline.json.begin(), end, '\n')),
                   encoding ? "is not glTF: its text is not UTF-8" : "is not glTF: its JSON cannot be parsed",
                   "is the export complete?"});
  } catch (const nlohmann::json::exception&) {
    return file.error("is not glTF: it has a number that is too large");
  }
  if (!gltf.is_object()) return file.error("is not glTF: its JSON is no object", "is the export complete?");
  outline.json = {};
  if (const Expected<void> readable = check_gltf_requirements(path, gltf); !readable)
    return Unexpected(readable.error());
  add_lost_gltf_features(path, gltf, loading.warnings);
  add_lost_gltf_references(path, gltf, loading.warnings);
  if (const Expected<void> read = read_gltf_buffers(file, gltf, parts->binary); !read)
    return Unexpected(read.error());
  file.data_uris.clear();  // they lie in `parts`
  if (const Expected<void> parsed = parse(file, gltf); !parsed) return Unexpected(parsed.error());
  if (const Expected<void> unpacked = unpack_draco(file); !unpacked) return Unexpected(unpacked.error());
  return file;
}

}  // namespace pinocchio
