#include <cstring>
#include <string_view>

#include "core/scene/gltf_file.h"
#include "core/scene/read_bytes.h"

namespace pinocchio {
namespace {

constexpr std::string_view kBinaryMagic = "glTF";

// tinygltf recurses into extras and extensions; this many levels fit any stack.
constexpr int kDeepest = 256;

bool nested_too_deep(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string && c == '\\') ++i;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if ((c == '[' || c == '{') && ++depth > kDeepest) return true;
    if (c == ']' || c == '}') --depth;
  }
  return false;
}

// A .glb's first chunk, else everything.
std::string_view json_of(std::string_view bytes) {
  constexpr std::size_t kLengthAt = 12, kJsonAt = 20;
  if (!bytes.starts_with(kBinaryMagic) || bytes.size() < kJsonAt) return bytes;
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + kLengthAt, sizeof length);
  return bytes.substr(kJsonAt, length);
}

// Decoding waits until it is known which images are shown: one that is broken or of a kind that stb does
// not read would fail the whole file here, and so would 16 bits a channel mislead.
bool keep_encoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);  // else tinygltf checked no range
  return true;
}

bool find_named_file(const std::string& file, void* gltf) {
  static_cast<GltfFile*>(gltf)->named_files.push_back(file);
  return tinygltf::FileExists(file, nullptr);
}

bool read_named_file(std::vector<unsigned char>* to, std::string* error, const std::string& file, void* gltf) {
  throw_if_cancelled(static_cast<GltfFile*>(gltf)->progress);
  return tinygltf::ReadWholeFile(to, error, file, nullptr);
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

Expected<GltfFile> read_gltf_file(const std::filesystem::path& path, std::vector<std::string>& warnings,
                                  Progress* progress) {
  GltfFile file{path, {}, {}, progress};
  const std::optional<std::string> read_file = read_bytes(path, progress);
  if (!read_file || read_file->empty()) return file.error("cannot be read", "is it yours to read?");
  const std::string& bytes = *read_file;
  constexpr std::size_t kMostBytes = 0xffffffffu;  // also what a .glb can say of itself
  if (bytes.size() > kMostBytes) return file.error("is larger than 4 GiB", "split it");
  if (nested_too_deep(json_of(bytes))) return file.error("is nested too deeply");

  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(keep_encoded, nullptr);
  reader.SetFsCallbacks({find_named_file, tinygltf::ExpandFilePath, read_named_file,
                         tinygltf::WriteWholeFile, &file});
  const auto size = static_cast<unsigned>(bytes.size());
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  std::string error, warning;
  bool read = false;
  try {
    read =
        bytes.starts_with(kBinaryMagic)
            ? reader.LoadBinaryFromMemory(&file.model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
            : reader.LoadASCIIFromString(&file.model, &error, &warning, bytes.data(), size, folder);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& e) {  // of the JSON library below, on values of the wrong type
    error = e.what();
  }
  if (!read)
    return file.error("is not glTF 2.0 that can be read: " + first_line(error), "is the export complete?");
  if (!warning.empty()) warnings.push_back(path.string() + ": " + first_line(warning));
  return file;
}

}  // namespace pinocchio
