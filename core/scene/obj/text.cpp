#include "core/scene/obj/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "core/base/decimal.h"
#include "core/files/text_lines.h"
#include "core/math/finite.h"
#include "core/scene/formats.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

template <class T>
std::optional<T> number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  T value{};
  const auto [end, failure] = read_decimal(word, value);
  if (failure != std::errc()) return std::nullopt;
  const std::string_view more = word.substr(as_size(end - word.data()));
  if constexpr (std::is_floating_point_v<T>)  // 1.#IND, 1.#QNAN, 1.#INF: how Microsoft's C library wrote them
    if (more.starts_with("#IND") || more.starts_with("#QNAN") || more.starts_with("#INF"))
      return static_cast<T>(NAN);
  return more.empty() ? std::optional<T>(value) : std::nullopt;
}

// The lists that the numbers of a face's corner (v/vt/vn) index.
enum Kind { kVertex, kTexcoord, kNormal, kKinds };
constexpr std::array<const char*, kKinds> kKindNames{"vertex", "texture coordinate", "normal"};

// Statements without effect on the picture, or part of others that have a warning.
constexpr std::string_view kQuiet[] = {"o",    "g",     "mg",   "vp",       "cstype",   "deg",   "bmat",
                                       "step", "parm",  "trim", "hole",     "scrv",     "sp",    "end",
                                       "con",  "bevel", "lod",  "c_interp", "d_interp", "ctech", "stech"};

constexpr int kLinesBetweenLooks = 4096;

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, Loading& loading)
      : file_(file.string()), warnings_(loading.warnings), strokes_(loading.strokes) {}

  Expected<ObjText> read(std::span<char> text, const Progress* progress) {
    join_lines(text);
    for (TextLines lines({text.data(), text.size()}); lines.next();) {
      line_ = lines.number();
      if (++seen_ % kLinesBetweenLooks == 0) throw_if_cancelled(progress);
      if (const Expected<void> read = read_line(lines.line()); !read) return Unexpected(read.error());
    }
    // Forward references are allowed, so the count is known only at the end.
    for (const Kind kind : {kVertex, kTexcoord, kNormal})
      if (highest_[kind].index > count(kind)) {
        const std::string what = highest_[kind].whose + " names " + kKindNames[kind] + " " +
                                 std::to_string(highest_[kind].index) + ", there are " +
                                 std::to_string(count(kind));
        if (kind == kVertex) return fail(highest_[kind].line, what);
        warnings_.add(
            {file_, "line " + std::to_string(highest_[kind].line), what,
             kind == kNormal ? "faces are shaded as without normals" : "its texture has one colour there"});
        leave_out_unknown(kind);
      }
    if (!obj_.colors.empty()) obj_.colors.resize(obj_.positions.size(), glm::vec3(1.0f));
    leave_out_unplaced();
    return std::move(obj_);
  }

 private:
  struct Reference {
    long long index = 0;
    int line = 0;
    std::string whose{};
  };

  Unexpected fail(int line, const std::string& what) const {
    return Unexpected(InputError{file_, line, what, "export the file again"});
  }

  [[nodiscard]] long long count(int kind) const {
    return static_cast<long long>(kind == kVertex     ? obj_.positions.size()
                                  : kind == kTexcoord ? obj_.texcoords.size()
                                                      : obj_.normals.size());
  }

  Expected<void> read_line(std::string_view line) {
    const std::string_view word = next_word(line);
    if (word.empty() || word.front() == '#') return {};
    if (word == "v") return read_position(line);
    if (word == "vn")
      return read_numbers(line, 3, 3, kNormal,
                          [this](const float* n) { obj_.normals.emplace_back(n[0], n[1], n[2]); });
    if (word == "vt")
      return read_numbers(line, 1, 2, kTexcoord,
                          [this](const float* t) { obj_.texcoords.emplace_back(t[0], t[1]); });
    if (word == "f") return read_face(line);
    if (word == "p" || word == "l") return read_stroke(word, line);
    if (word == "s")
      group_ = number<std::uint32_t>(next_word(line)).value_or(0);  // "off" is 0
    else if (word == "usemtl")
      material_ = material_of(trimmed(line));
    else if (word == "mtllib")
      obj_.libraries.emplace_back(trimmed(line));
    else
      warn_of(word);
    return {};
  }

  // A warning: the picture can be drawn without.
  void leave_out_unknown(Kind kind) {
    for (ObjText::Corner& corner : obj_.corners)
      if (int& index = kind == kNormal ? corner.normal : corner.texcoord; index >= count(kind)) index = -1;
  }

  // Leaves out faces with a corner whose position is not finite.
  void leave_out_unplaced() {
    if (first_unplaced_ == 0) return;
    std::erase_if(obj_.faces, [this](const ObjText::Face& face) {
      const std::span corners = std::span(obj_.corners).subspan(face.first, face.count);
      if (std::ranges::all_of(corners, [this](const ObjText::Corner& corner) {
            return is_finite(obj_.positions[corner.position]);
          }))
        return false;
      line_ = first_unplaced_;
      lost("v", kUnplaced, kNotDrawn);
      return true;
    });
  }

  int material_of(std::string_view name) {
    const auto [at, is_new] = material_names_.try_emplace(std::string(name), as_int(obj_.materials.size()));
    if (is_new) obj_.materials.emplace_back(name);
    return at->second;
  }

  void lost(std::string_view keyword, std::string_view what, std::string_view loss) {
    const std::string where =
        "line " + std::to_string(line_) + " (" + std::string(keyword.substr(0, 20)) + ")";
    warnings_.add({file_, where, std::string(what), std::string(loss)});
  }

  void warn_of(std::string_view keyword) {
    if (keyword == "curv" || keyword == "curv2" || keyword == "surf")
      return lost(keyword, "curves and free-form surfaces are left out", "they are not drawn");
    if (std::find(std::begin(kQuiet), std::end(kQuiet), keyword) == std::end(kQuiet))
      lost(keyword, "unknown statements are left out", "what they stand for is missing");
  }

  // x y z, x y z w, or x y z r g b
  Expected<void> read_position(std::string_view line) {
    Expected<void> read = read_numbers(line, 3, 6, kVertex, [this](const float* v) {
      if (given_ == 6) {
        obj_.colors.resize(obj_.positions.size(), glm::vec3(1.0f));
        obj_.colors.emplace_back(v[3], v[4], v[5]);
      }
      obj_.positions.emplace_back(v[0], v[1], v[2]);
    });
    return read;
  }

  template <class Take>
  Expected<void> read_numbers(std::string_view line, int least, int most, Kind kind, Take take) {
    std::array<float, 6> values{};
    bool unfit = false;
    for (given_ = 0; given_ < most; ++given_) {
      const std::string_view word = next_word(line);
      if (given_ >= least && (word.empty() || word.front() == '#')) break;
      const std::optional<double> value = number<double>(word);
      values[given_] = as_float(value.value_or(NAN));
      if (std::isfinite(values[given_])) continue;
      if (kind == kVertex && given_ < 3 && value)  // nan
        first_unplaced_ = first_unplaced_ > 0 ? first_unplaced_ : line_;
      else if (value)
        unfit = true;
      else if (word.empty())
        return fail(line_, std::string("a ") + kKindNames[kind] + " has too few numbers");
      else
        return fail(line_, "'" + std::string(word.substr(0, 40)) + "' in a " + kKindNames[kind] +
                               " is not a finite number");
    }
    if (unfit) {  // white, flat, or the texture's corner
      std::fill(values.begin() + (kind == kVertex ? 3 : 0), values.end(), kind == kVertex ? 1.0f : 0.0f);
      lost(kind == kVertex ? "v" : kind == kNormal ? "vn" : "vt", kUnfit, kUnfitLost);
    }
    take(values.data());
    return {};
  }

  Expected<void> read_face(std::string_view line) {
    const std::size_t first = obj_.corners.size();
    if (const Expected<void> read = read_corners("a face", line); !read) return read;
    const std::size_t corners = obj_.corners.size() - first;
    if (corners < 3) {  // exporters write some; they have no area
      obj_.corners.resize(first);
      lost("f", "faces of fewer than three corners are left out", kNotDrawn);
      return {};
    }
    obj_.faces.push_back({first, corners, group_, material_, line_});
    return {};
  }

  // p v ..., l v/vt ...; not read where it is not drawn
  Expected<void> read_stroke(std::string_view keyword, std::string_view line) {
    const bool is_point = keyword == "p";
    PointsAndLines::Kind& kind = is_point ? strokes_.points : strokes_.lines;
    if (!kind.drawn()) {
      kind.leave_out("line " + std::to_string(line_) + " (" + std::string(keyword) + ")");
      return {};
    }
    const std::size_t first = obj_.corners.size();
    if (const Expected<void> read = read_corners(is_point ? "a point" : "a line", line); !read) return read;
    const std::size_t corners = obj_.corners.size() - first;
    if (corners >= (is_point ? 1u : 2u)) {
      obj_.strokes.push_back({first, corners, is_point, material_, line_});
    } else {
      obj_.corners.resize(first);
      lost(
          keyword,
          is_point ? "points without a vertex are left out" : "lines of fewer than two vertices are left out",
          kNotDrawn);
    }
    return {};
  }

  Expected<void> read_corners(const char* whose, std::string_view line) {
    whose_ = whose;
    for (std::string_view corner; !(corner = next_word(line)).empty() && corner.front() != '#';)
      if (const Expected<void> read = read_corner(corner); !read) return read;
    return {};
  }

  // v, v/vt, v//vn or v/vt/vn; slashes may end it
  Expected<void> read_corner(std::string_view corner) {
    const std::string_view whole = corner.substr(0, 40);
    std::array<int, kKinds> indices{-1, -1, -1};
    while (corner.ends_with('/')) corner.remove_suffix(1);
    for (int kind = 0; kind < kKinds; ++kind) {
      const std::size_t end = std::min(corner.find('/'), corner.size());
      const std::string_view word = corner.substr(0, end);
      corner.remove_prefix(std::min(end + 1, corner.size()));
      if (word.empty() && kind != kVertex) continue;
      const std::optional<long long> index = number<long long>(word);
      if (index == 0 && kind != kVertex) {
        lost("f", std::string("the index 0 of a ") + kKindNames[kind] + " is left out: they count from 1",
             kind == kNormal ? "faces are shaded as without normals" : "its texture has one colour there");
        continue;
      }
      if (!index || *index == 0 || *index < -count(kind) || *index > std::numeric_limits<int>::max())
        return fail(line_, whose_ + " names " + std::string(kKindNames[kind]) + " '" +
                               std::string(word.substr(0, 40)) + "', there are " +
                               std::to_string(count(kind)) + " so far");
      indices[kind] = as_int(*index > 0 ? *index - 1 : count(kind) + *index);
      if (*index > highest_[kind].index) highest_[kind] = {*index, line_, whose_};
    }
    if (!corner.empty())
      return fail(line_, whose_ + " has the corner '" + std::string(whole) +
                             "', which has text after the index of its normal");
    obj_.corners.push_back({indices[kVertex], indices[kTexcoord], indices[kNormal]});
    return {};
  }

  std::string file_;
  Warnings& warnings_;
  PointsAndLines& strokes_;
  std::string whose_;  // "a face": what has the corners that are read
  ObjText obj_;
  std::unordered_map<std::string, int> material_names_;
  std::array<Reference, kKinds> highest_{};
  int line_ = 0, given_ = 0, material_ = -1;
  int first_unplaced_ = 0;  // line of the first vertex that is not finite; 0: there is none
  long long seen_ = 0;
  std::uint32_t group_ = 0;
};

}  // namespace

Expected<ObjText> read_obj_text(std::span<char> text, const std::filesystem::path& file, Loading& loading) {
  return ObjReader(file, loading).read(text, loading.progress);
}

}  // namespace pinocchio
