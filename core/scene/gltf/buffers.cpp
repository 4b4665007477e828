#include "core/scene/gltf/buffers.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/files/base64.h"
#include "core/files/input_file.h"
#include "core/scene/gltf/format/json.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

// Replaces %20 and the like by the bytes that they stand for.
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

// A data URI's bytes, in base64 or percent-encoded; none: the URI names a file.
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
  const Json* const uri_member = member(&buffer, "uri");
  if (!uri_member || !uri_member->is_string()) {
    file.buffers.push_back(index == 0 ? chunk : std::span<const unsigned char>());
  } else {
    const std::string& uri = uri_member->get_ref<const std::string&>();
    if (std::optional<FileBytes> data = data_of(file, uri)) {
      file.add_buffer(std::move(*data));
    } else {
      const std::filesystem::path path = file.files->named(decode_percent(uri));
      file.named_files.push_back(path.string());
      Expected<FileBytes> bytes = file.files->read(path, file.progress);
      if (!bytes) return file.error("its " + whose + " cannot be read: " + bytes.error().message());
      file.add_buffer(std::move(*bytes));
    }
    const std::size_t length = value_member<std::size_t>(&buffer, "byteLength").value_or(0);
    if (file.buffers.back().size() < length)
      return file.error("its " + whose + " holds " + std::to_string(file.buffers.back().size()) +
                            " bytes, byteLength says " + std::to_string(length),
                        "is the export complete?");
  }
  return {};
}

Expected<GltfBufferView> view_of(GltfFile& file, const Json& json, const std::string& whose) {
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const Json* const packed = extension(&json, name);
    if (!packed) continue;
    Expected<FileBytes> bytes = unpack_meshopt(file, *packed, name, whose);
    if (!bytes) return Unexpected(bytes.error());
    const GltfBufferView view{as_int(file.buffers.size()), 0, bytes->size(),
                              value_member<std::size_t>(packed, "byteStride").value_or(0)};
    file.add_buffer(std::move(*bytes));
    return view;
  }
  const auto size = [&](const char* key) { return value_member<std::size_t>(&json, key).value_or(0); };
  return GltfBufferView{index_member(&json, "buffer"), size("byteOffset"), size("byteLength"),
                        size("byteStride")};
}

GltfImage image_of(GltfFile& file, const Json& json) {
  GltfImage image;
  image.name = text_member(&json, "name");
  if (const Json* view = member(&json, "bufferView")) image.buffer_view = index_of(*view);
  const std::string uri = text_member(&json, "uri");
  if (std::optional<FileBytes> data = data_of(file, uri)) {
    image.bytes = file.store(std::move(*data));
  } else if (!uri.empty()) {
    image.file = file.files->named(decode_percent(uri)).string();
    file.named_files.push_back(image.file);
  }
  return image;
}

}  // namespace

const Json& GltfFile::items(const char* collection) const {
  return array_member(json.get(), collection);
}

Expected<void> read_gltf_buffers(GltfFile& file, std::span<const unsigned char> binary_chunk) {
  const Json& buffers = file.items("buffers");
  for (std::size_t i = 0; i < buffers.size(); ++i)
    if (const Expected<void> read = read_buffer(file, buffers[i], i, binary_chunk); !read) return read;
  const Json& views = file.items("bufferViews");
  for (std::size_t i = 0; i < views.size(); ++i) {
    Expected<GltfBufferView> view = view_of(file, views[i], "buffer view " + std::to_string(i));
    if (!view) return Unexpected(view.error());
    file.buffer_views.push_back(*view);
  }
  for (const Json& json : file.items("images")) file.images.push_back(image_of(file, json));
  return {};
}

}  // namespace pinocchio
