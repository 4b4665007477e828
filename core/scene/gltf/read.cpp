#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/files/input_file.h"
#include "core/scene/gltf/buffers.h"
#include "core/scene/gltf/format/features.h"
#include "core/scene/gltf/format/variants.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr std::string_view kBinaryMagic = "glTF";

// Readers recurse into the JSON; this many levels fit any stack.
constexpr int kDeepest = 256;

// JSON without its long data URIs: the JSON library would copy the base64 of buffers and images byte by byte.
// kDataAside and the index in `data_uris` take a URI's place.
struct Outline {
  std::string json;
  std::vector<std::string_view> data_uris;
  bool too_deep = false;
};

Outline outline_of(std::string_view text) {
  constexpr std::size_t kLong = 1024;
  Outline outline;
  std::size_t copied = 0;  // bytes of `text` that are in outline.json
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') ++i;
    if (c == '"') in_string = !in_string;
    if (in_string && c == '"' && text.substr(i + 1).starts_with("data:")) {
      const std::string_view uri = text.substr(i + 1, text.find('"', i + 1) - (i + 1));
      if (uri.size() < kLong || uri.find('\\') != uri.npos) continue;
      outline.json.append(text.substr(copied, i + 1 - copied))
          .append(kDataAside)
          .append(std::to_string(outline.data_uris.size()));
      outline.data_uris.push_back(uri);
      i += uri.size();
      copied = i + 1;
    }
    if (in_string) continue;
    if ((c == '[' || c == '{') && ++depth > kDeepest) outline.too_deep = true;
    if (c == ']' || c == '}') --depth;
  }
  outline.json.append(text.substr(copied));
  return outline;
}

// A file's parts: its JSON, and a .glb's binary chunk.
struct Parts {
  FileBytes text;  // all of a .gltf; empty: the parts lie in GltfFile::storage
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
  // Chunks of other types, and what follows the first two, are ignored.
  for (std::size_t at = kHeader;
       at + kChunkHeader <= kept.size() && (parts.json.empty() || parts.binary.empty());) {
    std::size_t length = number_at(kept, at);
    const std::uint32_t type = number_at(kept, at + 4);
    at += kChunkHeader;
    if (length > kept.size() - at && length - (kept.size() - at) < kAlignment && type == kBinary) {
      length = kept.size() - at;  // the last chunk's length counts padding that is missing
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
        InputError{path.string(), 1 + as_int(std::count(outline.json.begin(), end, '\n')),
                   encoding ? "is not glTF: its text is not UTF-8" : "is not glTF: its JSON cannot be parsed",
                   "is the export complete?"});
  } catch (const nlohmann::json::exception&) {
    return file.error("is not glTF: it has a number that is too large");
  }
  if (!gltf.is_object()) return file.error("is not glTF: its JSON is no object", "is the export complete?");
  outline.json = {};
  file.json = std::make_shared<const nlohmann::json>(std::move(gltf));
  if (const Expected<void> readable = check_gltf_requirements(path, *file.json); !readable)
    return Unexpected(readable.error());
  Expected<int> variant = chosen_gltf_variant(path, *file.json, loading.options.variant);
  if (!variant) return Unexpected(variant.error());
  file.variant = *variant;
  add_lost_gltf_features(path, *file.json, file.variant, loading);
  add_lost_gltf_references(path, *file.json, loading.warnings);
  if (const Expected<void> read = check_gltf_objects(file)
                                      .and_then([&] { return read_gltf_buffers(file, parts->binary); })
                                      .and_then([&] { return read_gltf_lists(file); })
                                      .and_then([&] { return unpack_draco(file); });
      !read)
    return Unexpected(read.error());
  file.data_uris.clear();  // they lie in `parts`
  return file;
}

}  // namespace pinocchio
