// STL (3D Systems 1989), binary and ascii: triangles that share nothing. Debian 12 packages no library for
// it.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "core/files/input_file.h"
#include "core/files/text_lines.h"
#include "core/math/finite.h"
#include "core/scene/formats.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr std::size_t kHeaderBytes = 80, kBeforeTriangles = kHeaderBytes + 4, kTriangleBytes = 50;
constexpr std::size_t kRowsBetweenLooks = 4096;

std::uint64_t bytes_of(std::uint32_t triangles) {
  return kBeforeTriangles + std::uint64_t{kTriangleBytes} * triangles;
}

std::uint32_t u32_at(const char* bytes) {
  const auto byte = [&](int i) { return as_uint32(static_cast<unsigned char>(bytes[i])); };
  return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

float float_at(const char* bytes) {
  const std::uint32_t bits = u32_at(bytes);
  float value = 0.0f;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

// The words of all lines, one after the other.
class Words {
 public:
  explicit Words(std::string_view text) : lines_(text) {}

  // Empty at the end.
  std::string_view next() {
    std::string_view word = next_word(line_);
    while (word.empty() && lines_.next()) {
      line_ = lines_.line();
      word = next_word(line_);
    }
    return word;
  }
  [[nodiscard]] int line() const { return lines_.number(); }  // of the last word, from 1
  // What follows the last word on its line.
  [[nodiscard]] std::string_view rest_of_line() const { return line_; }
  void skip_line() { line_ = {}; }

 private:
  TextLines lines_;
  std::string_view line_;
};

bool is_word(std::string_view word, std::string_view wanted) {
  return std::ranges::equal(word, wanted, [](char a, char b) { return (a | 0x20) == b; });
}

class StlReader {
 public:
  StlReader(const std::filesystem::path& path, const FileBytes& bytes, Loading& loading)
      : path_(path), bytes_(bytes), loading_(loading) {}

  // Many binary files begin with "solid" too: those whose size fits their number of triangles are binary.
  Expected<MeshData> read() {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    std::string_view text = bytes_.text();
    const bool has_count = text.size() >= kBeforeTriangles;
    const std::uint32_t count = has_count ? u32_at(text.data() + kHeaderBytes) : 0;
    const std::size_t in_file = text.size();
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    const bool says_solid = is_word(Words(text.substr(0, kHeaderBytes)).next(), "solid");
    const bool is_text = says_solid && text.find('\0') == std::string_view::npos;
    const Expected<void> done = has_count && bytes_of(count) == in_file ? binary(count)
                                : is_text                               ? ascii(text)
                                : has_count                             ? of_other_size(count)
                                                                        : no_stl();
    if (!done) return Unexpected(done.error());
    mesh_.normals.assign(mesh_.positions.size(), glm::vec3(0.0f));  // flat
    mesh_.materials.emplace_back().name = "default";
    mesh_.triangle_materials.assign(mesh_.triangles.size(), 0);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] Unexpected error(int line, const std::string& what, const std::string& remedy) const {
    return Unexpected(InputError{path_.string(), line, what, remedy});
  }
  [[nodiscard]] Expected<void> no_stl() const {
    return error(0, "is not STL: it neither begins with 'solid' nor has a header of 84 bytes",
                 "is the export complete?");
  }

  void lost(const std::string& what, const std::string& loss) {
    loading_.warnings.add({path_.string(), "", what, loss});
  }

  // What follows the last triangle is left out, and what is missing is an error.
  Expected<void> of_other_size(std::uint32_t count) {
    if (bytes_of(count) > bytes_.size())
      return error(0,
                   "states " + std::to_string(count) + " triangles, its " + std::to_string(bytes_.size()) +
                       " bytes hold " + std::to_string((bytes_.size() - kBeforeTriangles) / kTriangleBytes),
                   "is the export complete?");
    lost("bytes after the last triangle are left out", "they may be a second part");
    return binary(count);
  }

  Expected<void> binary(std::uint32_t count) {
    begin_phase(loading_.progress, "mesh", count);
    mesh_.positions.reserve(std::size_t{3} * count);
    mesh_.triangles.reserve(count);
    bool colored = false;
    for (std::uint32_t i = 0; i < count; ++i) {
      const char* const at = bytes_.data() + kBeforeTriangles + std::size_t{kTriangleBytes} * i;
      std::array<glm::vec3, 3> corners;
      for (int corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis)
          corners[as_size(corner)][axis] = float_at(at + 12 + 12 * corner + 4 * axis);
      add(corners);
      colored = colored || at[48] != 0 || at[49] != 0;
      if (i % kRowsBetweenLooks == kRowsBetweenLooks - 1) advance(loading_.progress, kRowsBetweenLooks);
    }
    if (colored) lost("colours of triangles are left out", "all of it has one colour");
    return {};
  }

  // facet normal x y z outer loop vertex x y z, three times, endloop endfacet. A solid's name is the rest of
  // its line, unless a facet begins there.
  Expected<void> ascii(std::string_view text) {
    begin_phase(loading_.progress, "mesh", as_double(text.size()));
    std::array<glm::vec3, 3> corners;
    std::size_t count = 0;  // of the facet's corners
    Words words(text);
    std::size_t seen = 0;
    for (std::string_view word; !(word = words.next()).empty();) {
      if (++seen % kRowsBetweenLooks == 0) throw_if_cancelled(loading_.progress);
      const int line = words.line();
      if (is_word(word, "vertex")) {
        if (count == 3) return error(line, "a facet has more than three vertices", "export it as triangles");
        if (!read_point(words, corners[count]))
          return error(line, "a vertex is not three numbers", "export it again");
        ++count;
      } else if (is_word(word, "endfacet")) {
        if (count != 3)
          return error(line, "a facet has " + std::to_string(count) + " vertices, not three",
                       "export it again");
        add(corners);
        count = 0;
      } else if ((is_word(word, "solid") || is_word(word, "endsolid")) && !has_facet(words.rest_of_line())) {
        words.skip_line();
      }
    }
    const int line = words.line();
    if (count != 0) return error(line, "ends within a facet", "is the export complete?");
    advance(loading_.progress, as_double(bytes_.size()));
    return {};
  }

  static bool has_facet(std::string_view line) {
    for (std::string_view word; !(word = next_word(line)).empty();)
      if (is_word(word, "facet")) return true;
    return false;
  }

  static bool read_point(Words& words, glm::vec3& point) {
    for (int axis = 0; axis < 3; ++axis) {
      std::string_view word = words.next();
      if (!word.empty() && word.front() == '+') word.remove_prefix(1);
      double value = 0.0;
      const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (word.empty() || failure == std::errc::invalid_argument || end != word.data() + word.size())
        return false;
      point[axis] = failure == std::errc() ? as_float(value) : HUGE_VALF;
    }
    return true;
  }

  void add(const std::array<glm::vec3, 3>& corners) {
    if (!std::ranges::all_of(corners, is_finite<3>)) return lost(kUnplaced, kNotDrawn);
    const auto first = as_uint32(mesh_.positions.size());
    mesh_.positions.insert(mesh_.positions.end(), corners.begin(), corners.end());
    mesh_.triangles.emplace_back(first, first + 1, first + 2);
  }

  const std::filesystem::path& path_;
  const FileBytes& bytes_;
  Loading& loading_;
  MeshData mesh_;
};

Expected<Scene> load_stl(const std::filesystem::path& path, Loading& loading) {
  const Expected<FileBytes> bytes = read_input_file(path, loading.progress);
  if (!bytes) return Unexpected(bytes.error());
  Expected<MeshData> mesh = StlReader(path, *bytes, loading).read();
  if (!mesh) return Unexpected(mesh.error());
  return Scene(std::move(*mesh));
}

}  // namespace

namespace room {
extern const SceneFormat stl{"STL", {".stl"}, load_stl, nullptr};
}  // namespace room

}  // namespace pinocchio
