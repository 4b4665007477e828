#include "core/scene/gltf_buffers.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/scene/base64.h"
#include "core/scene/input_file.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

// %20 and its like.
std::string decode_percent(std::string_view uri) {
  std::string text;
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      text.push_back(static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])));
      i += 2;
    } else {
      text.push_back(uri[i]);
    }
  }
  return text;
}

FileBytes bytes_of(std::string_view text) {
  FileBytes bytes(text.size());
  std::ranges::copy(text, bytes.begin());
  return bytes;
}

// What a data URI holds, in base64 or as it is with %00 and its like; nothing where the URI is a file's.
std::optional<FileBytes> data_of(const GltfFile& file, std::string_view uri) {
  if (!uri.starts_with("data:")) return std::nullopt;
  std::size_t aside = 0;
  if (uri.starts_with(kDataAside) &&
      std::from_chars(uri.data() + kDataAside.size(), uri.data() + uri.size(), aside).ec == std::errc() &&
      aside < file.data_uris.size())
    uri = file.data_uris[aside];
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return FileBytes();
  const std::string_view data = uri.substr(comma + 1);
  return uri.substr(0, comma).ends_with(";base64") ? decode_base64(data) : bytes_of(decode_percent(data));
}

Expected<void> read_buffer(GltfFile& file, const Json& buffer, std::size_t index,
                           std::span<const unsigned char> chunk) {
  const std::string whose = "buffer " + std::to_string(index);
  const auto uri_at = buffer.find("uri");
  if (uri_at == buffer.end() || !uri_at->is_string()) {
    file.buffers.push_back(index == 0 ? chunk : std::span<const unsigned char>());
  } else {
    const std::string& uri = uri_at->get_ref<const std::string&>();
    if (std::optional<FileBytes> data = data_of(file, uri)) {
      file.add_buffer(std::move(*data));
    } else {
      const std::filesystem::path path = file.files->named(decode_percent(uri));
      file.named_files.push_back(path.string());
      Expected<FileBytes> bytes = file.files->read(path, file.progress);
      if (!bytes) return file.error("its " + whose + " cannot be read: " + bytes.error().message());
      file.add_buffer(std::move(*bytes));
    }
    const std::size_t length = size_member(buffer, "byteLength").value_or(0);
    if (file.buffers.back().size() < length)
      return file.error("its " + whose + " holds " + std::to_string(file.buffers.back().size()) +
                            " bytes, byteLength says " + std::to_string(length),
                        "is the export complete?");
  }
  return {};
}

Expected<tinygltf::BufferView> view_of(GltfFile& file, const Json& json, const std::string& whose) {
  tinygltf::BufferView view;
  const auto extensions = json.find("extensions");
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (extensions == json.end() || !extensions->is_object() || !extensions->contains(name)) continue;
    const Json& packed = extensions->at(name);
    Expected<FileBytes> bytes = unpack_meshopt(file, packed, name, whose);
    if (!bytes) return Unexpected(bytes.error());
    view.byteLength = bytes->size();
    view.byteStride = size_member(packed, "byteStride").value_or(0);
    view.buffer = static_cast<int>(file.buffers.size());
    file.add_buffer(std::move(*bytes));
    return view;
  }
  const std::optional<std::size_t> buffer = size_member(json, "buffer");
  view.buffer = buffer ? static_cast<int>(std::min<std::size_t>(*buffer, 0x7fffffff)) : -1;
  view.byteOffset = size_member(json, "byteOffset").value_or(0);
  view.byteLength = size_member(json, "byteLength").value_or(0);
  view.byteStride = size_member(json, "byteStride").value_or(0);
  return view;
}

const Json& array_member(const Json& gltf, const char* key) {
  static const Json kNone = Json::array();
  const auto found = gltf.find(key);
  return found != gltf.end() && found->is_array() ? *found : kNone;
}

}  // namespace

std::string text_member(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<std::size_t> size_member(const Json& object, const char* key) {
  if (!object.is_object()) return std::nullopt;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  if (found->is_number_unsigned()) return found->get<std::size_t>();
  const double value = found->get<double>();  // some exporters write 12.0
  if (!(value >= 0.0 && value < 9e15)) return std::nullopt;
  return static_cast<std::size_t>(value);
}

Expected<void> read_gltf_buffers(GltfFile& file, const Json& gltf,
                                 std::span<const unsigned char> binary_chunk) {
  for (const char* key : {"buffers", "bufferViews", "images"})
    for (const Json& item : array_member(gltf, key))
      if (!item.is_object()) return file.error(std::string("its ") + key + " are not all objects");
  const Json& buffers = array_member(gltf, "buffers");
  for (std::size_t i = 0; i < buffers.size(); ++i)
    if (const Expected<void> read = read_buffer(file, buffers[i], i, binary_chunk); !read) return read;
  const Json& views = array_member(gltf, "bufferViews");
  for (std::size_t i = 0; i < views.size(); ++i) {
    Expected<tinygltf::BufferView> view = view_of(file, views[i], "buffer view " + std::to_string(i));
    if (!view) return Unexpected(view.error());
    file.model.bufferViews.push_back(std::move(*view));
  }
  for (const Json& json : array_member(gltf, "images")) {
    tinygltf::Image& image = file.model.images.emplace_back();
    image.name = text_member(json, "name");
    image.mimeType = text_member(json, "mimeType");
    image.bufferView = static_cast<int>(
        std::min<std::size_t>(size_member(json, "bufferView").value_or(views.size()), views.size()));
    if (!json.contains("bufferView")) image.bufferView = -1;
    const std::string uri = text_member(json, "uri");
    if (std::optional<FileBytes> data = data_of(file, uri)) {
      image.image.assign(data->begin(), data->end());
    } else if (!uri.empty()) {
      image.uri = file.files->named(decode_percent(uri)).string();
      file.named_files.push_back(image.uri);
    }
  }
  return {};
}

}  // namespace pinocchio
