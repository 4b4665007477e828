// Primitives of points and of lines.
#include "core/scene/strokes.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/scene/gltf/deformation.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The vertices of a primitive, in its mesh's space.
class StrokeReader {
 public:
  StrokeReader(const GltfFile& file, const GltfPrimitive& primitive) : file_(file), primitive_(primitive) {}

  Expected<void> read() {
    const Expected<std::size_t> count = file_.count(primitive_.attribute("POSITION"));
    if (!count) return Unexpected(count.error());
    count_ = *count;
    return file_.append(primitive_.attribute("POSITION"), vertices.positions)
        .and_then([&] { return append("TEXCOORD_0", vertices.texcoords); })
        .and_then([&] { return append("TEXCOORD_1", vertices.texcoords1); })
        .and_then([&] { return append_colors(); });
  }

  Expected<std::vector<Stroke>> strokes(std::uint32_t material) const {
    std::vector<std::uint32_t> corners(count_);
    std::iota(corners.begin(), corners.end(), 0u);
    if (primitive_.indices >= 0) {
      Expected<std::vector<std::uint32_t>> read = file_.indices(primitive_.indices);
      if (!read) return Unexpected(read.error());
      corners = std::move(*read);
    }
    for (const std::uint32_t corner : corners)
      if (corner >= count_)
        return file_.error("names vertex " + std::to_string(corner) + ", it has " + std::to_string(count_));
    std::vector<Stroke> strokes(stroke_count(primitive_.mode, corners.size()));
    const bool points = primitive_.mode == kGltfPoints;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      const std::size_t begin = primitive_.mode == kGltfLines ? 2 * i : i;
      const std::size_t end = points ? begin : (begin + 1) % corners.size();
      strokes[i] = {corners[begin], corners[end], points, material};
    }
    return strokes;
  }

  [[nodiscard]] std::size_t count() const { return count_; }

  MeshData vertices;

 private:
  template <class T>
  Expected<void> append(const char* attribute, std::vector<T>& to) const {
    const int accessor = primitive_.attribute(attribute);
    if (accessor < 0) return {};
    Expected<void> read = file_.append(accessor, to);
    if (read && to.size() != count_)
      return file_.error("accessor " + std::to_string(accessor) + " does not hold one element a vertex");
    return read;
  }

  Expected<void> append_colors() {
    const int accessor = primitive_.attribute("COLOR_0");
    if (!in_range(accessor, file_.accessors) || item_of(file_.accessors, accessor).components != 3)
      return append("COLOR_0", vertices.colors);
    std::vector<glm::vec3> rgb;
    Expected<void> read = append("COLOR_0", rgb);
    for (const glm::vec3& c : rgb) vertices.colors.emplace_back(c, 1.0f);
    return read;
  }

  const GltfFile& file_;
  const GltfPrimitive& primitive_;
  std::size_t count_ = 0;
};

// Balls and tubes are round in the world as the file places them, whatever the scale of their nodes.
void place_at_rest(const AddedStrokes& added, const MeshData& vertices, const glm::mat4& world_from_mesh,
                   std::size_t first, MeshData& to, RestPose& rest) {
  const glm::mat3 linear(world_from_mesh), inverse = glm::inverse(linear);
  const float determinant = glm::determinant(linear);
  const bool flat = !(std::abs(determinant) > 0.0f) || !std::isfinite(1.0f / determinant);
  const bool in_place = flat || world_from_mesh == glm::mat4(1.0f);
  const Placement placement(world_from_mesh);
  rest.positions.resize(first);
  rest.normals.resize(first, glm::vec3(0.0f));
  for (std::size_t i = 0; i < added.sources.size(); ++i) {
    const glm::vec3 center = vertices.positions[added.sources[i]];
    glm::vec3& normal = to.normals[first + i];
    if (in_place) {
      rest.positions.push_back(center + added.offsets[i]);
      rest.normals.push_back(normal);
    } else {
      rest.positions.push_back(center + inverse * added.offsets[i]);
      rest.normals.push_back(glm::normalize(glm::transpose(linear) * normal));
    }
    if (world_from_mesh == glm::mat4(1.0f)) continue;
    to.positions[first + i] = placement.position(rest.positions.back());
    normal = placement.normal(rest.normals.back());
  }
  if (!rest.tangents.empty()) rest.tangents.resize(rest.positions.size());
}

}  // namespace

bool is_stroke_mode(int mode) {
  return mode >= kGltfPoints && mode <= kGltfLineStrip;
}

std::size_t stroke_count(int mode, std::size_t corners) {
  if (mode == kGltfPoints) return corners;
  if (mode == kGltfLines) return corners / 2;
  return corners < 2 ? 0 : mode == kGltfLineLoop ? corners : corners - 1;
}

Expected<std::size_t> add_gltf_strokes(const GltfFile& file, const GltfPrimitive& primitive,
                                       const glm::mat4& world_from_mesh, std::uint32_t default_material,
                                       MeshData& to, RestPose& rest, DeformationReader* deformation,
                                       const PointsAndLines& how) {
  const nlohmann::json& materials = file.items("materials");
  if (primitive.material >= 0 && !in_range(primitive.material, materials))
    return file.error("names material " + which_of(primitive.material, materials));
  StrokeReader reader(file, primitive);
  if (const Expected<void> read = reader.read(); !read) return Unexpected(read.error());
  const Expected<std::vector<Stroke>> strokes =
      reader.strokes(primitive.material >= 0 ? as_uint32(primitive.material) : default_material);
  if (!strokes) return Unexpected(strokes.error());
  const MeshData& at_rest = reader.vertices;
  MeshData placed;  // the vertices as the world has them
  placed.texcoords = at_rest.texcoords, placed.texcoords1 = at_rest.texcoords1;
  placed.colors = at_rest.colors;
  const Placement placement(world_from_mesh);
  for (const glm::vec3& p : at_rest.positions) placed.positions.push_back(placement.position(p));
  const std::size_t first = to.positions.size();
  const AddedStrokes added = add_strokes(*strokes, placed, how, file.progress, to);
  place_at_rest(added, at_rest, world_from_mesh, first, to, rest);
  if (deformation && !added.sources.empty())
    if (const Expected<void> deforms =
            deformation->add(primitive, as_uint32(first), reader.count(), added.sources);
        !deforms)
      return Unexpected(deforms.error());
  return added.unplaced;
}

}  // namespace pinocchio
