#include "core/scene/strokes.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/round.h"
#include "core/math/finite.h"
#include "core/scene/formats.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Appends an attribute; vertices without have `none`, and an attribute that no vertex has stays empty.
template <class T>
void append_column(const std::vector<T>& from, std::span<const std::uint32_t> sources, const T& none,
                   std::size_t before, std::vector<T>& to) {
  if (from.empty() && to.empty()) return;
  to.resize(before, none);
  to.reserve(before + sources.size());
  for (const std::uint32_t source : sources) to.push_back(from.empty() ? none : from[source]);
}

class StrokeMaker {
 public:
  StrokeMaker(const MeshData& from, const PointsAndLines& how, MeshData& to)
      : from_(from), how_(how), to_(to), ball_(round_ball(how.detail)), tube_(round_tube(how.detail)) {}

  void add(const Stroke& stroke) {
    const glm::vec3 &begin = from_.positions[stroke.begin], &end = from_.positions[stroke.end];
    if (!is_finite(begin) || !is_finite(end)) {
      ++added_.unplaced;
      return;
    }
    const glm::vec3 along = end - begin;
    const float length = glm::length(along);
    const bool is_line = !stroke.is_point && length > 0.0f && std::isfinite(length);
    const float radius = 0.5f * (stroke.is_point ? how_.points : how_.lines).diameter;
    const RoundShape& shape = is_line ? tube_ : ball_;  // a line of no length is a ball
    const glm::mat3 frame = is_line ? frame_along(along / length) : glm::mat3(1.0f);
    const auto first = as_uint32(to_.positions.size());
    for (std::size_t i = 0; i < shape.normals.size(); ++i) {
      const std::uint32_t source = shape.ends[i] == 0 ? stroke.begin : stroke.end;
      const glm::vec3 normal = frame * shape.normals[i], offset = radius * shape.reach * normal;
      added_.sources.push_back(source);
      added_.offsets.push_back(offset);
      to_.positions.push_back(from_.positions[source] + offset);
      to_.normals.push_back(normal);
    }
    for (const glm::uvec3& triangle : shape.triangles) to_.triangles.push_back(triangle + first);
    to_.triangle_materials.resize(to_.triangles.size(), stroke.material);
  }

  AddedStrokes added() { return std::move(added_); }

 private:
  const MeshData& from_;
  const PointsAndLines& how_;
  MeshData& to_;
  RoundShape ball_, tube_;
  AddedStrokes added_;
};

}  // namespace

Expected<void> take_strokes(const std::string& file, double points, double lines, Loading& loading) {
  if (points + lines == 0.0) return {};
  // A vertex of the mesh and while it is made, a triangle with its share of the tree (measured).
  constexpr double kVertexBytes = 128.0, kTriangleBytes = 160.0;
  loading.strokes.detail = round_detail_for(points + lines);
  const RoundDetail& detail = kRoundDetails[as_size(loading.strokes.detail)];
  const double triangles = points * detail.ball_triangles + lines * detail.tube_triangles(),
               vertices = points * detail.ball_vertices + lines * detail.tube_vertices();
  constexpr double kMost = 9e18;  // fits 64 bits
  const auto whole = [](double number) {
    return static_cast<std::uint64_t>(std::min(number, double{kMost}));
  };
  const std::string what = std::to_string(whole(points)) + " points and " + std::to_string(whole(lines)) +
                           " lines as " + std::to_string(whole(triangles)) + " triangles";
  if (triangles > kMaxTriangles)
    return Unexpected(InputError{file, 0,
                                 "draws " + what + ", and the limit is " + std::to_string(kMaxTriangles),
                                 "split it, or leave out --point-size and --line-width"});
  if (!loading.limit.take(file, "drawing " + what,
                          whole(triangles * kTriangleBytes + vertices * kVertexBytes), 1))
    return Unexpected(*loading.limit.error());
  return {};
}

AddedStrokes add_strokes(std::span<const Stroke> strokes, const MeshData& from, const PointsAndLines& how,
                         const Progress* progress, MeshData& to) {
  if (strokes.empty()) return {};
  constexpr std::size_t kBetweenLooks = 4096;
  const std::size_t before = to.positions.size();
  StrokeMaker maker(from, how, to);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    if (i % kBetweenLooks == 0) throw_if_cancelled(progress);
    maker.add(strokes[i]);
  }
  AddedStrokes added = maker.added();
  append_column(from.texcoords, added.sources, glm::vec2(0.0f), before, to.texcoords);
  append_column(from.texcoords1, added.sources, glm::vec2(0.0f), before, to.texcoords1);
  append_column(from.colors, added.sources, glm::vec4(1.0f), before, to.colors);
  append_column({}, added.sources, glm::vec4(0.0f), before, to.tangents);
  return added;
}

void warn_of_unplaced(const std::string& file, const std::string& where, std::size_t unplaced,
                      Warnings& warnings) {
  const auto warn = [&](const char* what, const char* lost) {
    if (unplaced > 0) warnings.add({file, where, what, lost, unplaced});
  };
  warn("points and lines on vertices that are no finite numbers are left out", kNotDrawn);
}

}  // namespace pinocchio
