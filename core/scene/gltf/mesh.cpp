#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/large_memory.h"
#include "core/math/finite.h"
#include "core/parallel/parts.h"
#include "core/scene/gltf/deformation.h"
#include "core/scene/strokes.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Accessors of a primitive's attributes; -1: it has none.
struct Attributes {
  int position = -1, normal = -1, texcoord = -1, texcoord1 = -1, color = -1, tangent = -1;
  std::vector<int> deforming{};
  auto operator<=>(const Attributes&) const = default;
};

// Where triangle i of a list, strip or fan finds its corners; a strip turns every other one around.
std::array<std::size_t, 3> corners_of(int mode, std::size_t i) {
  if (mode == kGltfTriangleStrip)
    return i % 2 == 0 ? std::array{i, i + 1, i + 2} : std::array{i + 1, i, i + 2};
  if (mode == kGltfTriangleFan) return {0, i + 1, i + 2};
  return {3 * i, 3 * i + 1, 3 * i + 2};
}

std::size_t triangle_count(int mode, std::size_t indices) {
  if (mode == kGltfTriangles) return indices / 3;
  return indices < 3 ? 0 : indices - 2;
}

constexpr std::size_t kPlacedAtOnce = 1 << 16;

// Vertices or triangles' corners, whichever are more.
std::size_t elements_of(const GltfFile& file, const GltfPrimitive& primitive) {
  std::size_t most = 0;
  for (const int accessor : {primitive.attribute("POSITION"), primitive.indices})
    if (in_range(accessor, file.accessors)) most = std::max(most, item_of(file.accessors, accessor).count);
  return most;
}

class MeshPlacer {
 public:
  MeshPlacer(const GltfFile& file, const glm::mat4& world_from_mesh, MeshData& mesh, RestPose& rest,
             DeformationReader* deformation)
      : file_(file),
        placement_(world_from_mesh),
        in_place_(world_from_mesh == glm::mat4(1.0f)),
        mesh_(mesh),
        rest_(rest),
        deformation_(deformation) {}

  Expected<void> add(const GltfPrimitive& primitive, std::uint32_t default_material) {
    const Attributes attributes{primitive.attribute("POSITION"),
                                primitive.attribute("NORMAL"),
                                primitive.attribute("TEXCOORD_0"),
                                primitive.attribute("TEXCOORD_1"),
                                primitive.attribute("COLOR_0"),
                                primitive.attribute("NORMAL") < 0 ? -1 : primitive.attribute("TANGENT"),
                                deformation_ ? deforming_accessors(primitive) : std::vector<int>()};
    const Expected<std::size_t> count = file_.count(attributes.position);
    if (!count) return Unexpected(count.error());
    // Primitives that share their accessors share the vertices.
    const auto [at, is_new] = placed_.try_emplace(attributes, as_uint32(mesh_.positions.size()));
    const std::uint32_t first = at->second;
    const std::size_t before = mesh_.triangles.size();
    std::vector<Job> jobs;
    if (is_new) jobs = vertex_jobs(attributes, first, *count);
    jobs.emplace_back(
        [&, count = *count] { return add_triangles(primitive, default_material, first, count); });
    if (const Expected<void> done = run(jobs, elements_of(file_, primitive)); !done) return done;
    if (is_new && deformation_)
      if (const Expected<void> added = deformation_->add(primitive, first, *count); !added) return added;
    if (has_unplaced_) leave_out_unplaced(before);
    for (std::size_t i = before; has_void_normals_ && i < mesh_.triangles.size(); ++i)
      is_partly_smooth_ |= is_partly_smooth(mesh_.triangles[i]);
    return {};
  }

  // How many triangles were left out, as a vertex of theirs is nowhere.
  [[nodiscard]] std::size_t unplaced() const { return unplaced_; }
  // How many normals, tangents, colours and texture coordinates were left out, as they are not finite.
  [[nodiscard]] std::size_t unfit() const { return unfit_; }
  // Vertices that are nowhere, which no triangle has.
  void forget_unplaced() {
    for (std::size_t i = first_vertex_; has_unplaced_ && i < rest_.positions.size(); ++i)
      if (!is_finite(rest_.positions[i])) rest_.positions[i] = mesh_.positions[i] = glm::vec3(0.0f);
  }

  // Whether some normals of a triangle have no length. All three without ask for its own, as we save it.
  [[nodiscard]] bool is_partly_smooth() const { return is_partly_smooth_; }

 private:
  void leave_out_unplaced(std::size_t first_triangle) {
    const auto begin = mesh_.triangles.begin() + static_cast<std::ptrdiff_t>(first_triangle);
    const auto end = std::remove_if(begin, mesh_.triangles.end(), [this](const glm::uvec3& t) {
      return !is_finite(rest_.positions[t.x]) || !is_finite(rest_.positions[t.y]) ||
             !is_finite(rest_.positions[t.z]);
    });
    unplaced_ += mesh_.triangles.end() - end;
    mesh_.triangles.erase(end, mesh_.triangles.end());
    mesh_.triangle_materials.resize(mesh_.triangles.size());
  }

  [[nodiscard]] bool is_partly_smooth(const glm::uvec3& triangle) const {
    int given = 0;
    for (int corner = 0; corner < 3; ++corner)
      given += rest_.normals[triangle[corner]] != glm::vec3(0.0f) ? 1 : 0;
    return given % 3 != 0;
  }

  // What fills arrays of its own, so that all of them can be done at once.
  using Job = std::function<Expected<void>()>;

  // Returns the first job's error where several fail.
  static Expected<void> run(std::span<const Job> jobs, std::size_t elements) {
    constexpr std::size_t kFew = std::size_t{1} << 15;  // are done before another thread has begun
    std::vector<Expected<void>> done(jobs.size());
    for_each_part(jobs.size(), elements > kFew ? 1 : jobs.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) done[i] = jobs[i]();
    });
    const auto failed = std::ranges::find_if(done, [](const Expected<void>& job) { return !job; });
    return failed == done.end() ? Expected<void>() : *failed;
  }

  // Vertices from `first` on, made of these accessors.
  std::vector<Job> vertex_jobs(const Attributes& attributes, std::size_t first, std::size_t count) {
    const auto texcoords = [=, this](int accessor, std::vector<glm::vec2>& to) {
      return [=, this, &to] { return append(accessor, first, count, glm::vec2(0.0f), to); };
    };
    return {[=, this] { return add_positions(attributes.position, first); },
            [=, this] { return add_normals(attributes.normal, first, count); },
            texcoords(attributes.texcoord, mesh_.texcoords),
            texcoords(attributes.texcoord1, mesh_.texcoords1),
            [=, this] { return append_colors(attributes.color, first, count); },
            [=, this] { return add_tangents(attributes.tangent, first, count); }};
  }

  // Appends the primitive's triangles, whose corners are counted from its vertex `first`.
  Expected<void> add_triangles(const GltfPrimitive& primitive, std::uint32_t default_material,
                               std::uint32_t first, std::size_t vertex_count) {
    const nlohmann::json& materials = file_.items("materials");
    if (primitive.material >= 0 && !in_range(primitive.material, materials))
      return file_.error("names material " + which_of(primitive.material, materials));
    const std::size_t before = mesh_.triangles.size();
    if (const Expected<void> added = add_corners(primitive, vertex_count); !added) return added;
    const std::span triangles = std::span(mesh_.triangles).subspan(before);
    glm::uvec3 most(0);
    for (const glm::uvec3& triangle : triangles) most = glm::max(most, triangle);
    if (const std::uint32_t last = std::max({most.x, most.y, most.z});
        !triangles.empty() && last >= vertex_count)
      return file_.error("names vertex " + std::to_string(last) + ", it has " + std::to_string(vertex_count));
    if (first > 0)
      for (glm::uvec3& triangle : triangles) triangle += first;
    if (placement_.mirrors())
      for (glm::uvec3& triangle : triangles) std::swap(triangle.y, triangle.z);
    resize_large(mesh_.triangle_materials, mesh_.triangles.size(),
                 primitive.material >= 0 ? as_uint32(primitive.material) : default_material);
    return {};
  }

  Expected<void> add_corners(const GltfPrimitive& primitive, std::size_t vertex_count) {
    throw_if_cancelled(file_.progress);
    std::size_t count = vertex_count;
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) {
      const Expected<std::size_t> given = file_.count(primitive.indices);
      if (!given) return Unexpected(given.error());
      count = *given;
      if (primitive.mode == kGltfTriangles && count % 3 == 0)
        return file_.append_triangles(primitive.indices, mesh_.triangles);
      Expected<std::vector<std::uint32_t>> read = file_.indices(primitive.indices);
      if (!read) return Unexpected(read.error());
      indices = std::move(*read);
    }
    const auto index = [&](std::size_t i) { return indices.empty() ? as_uint32(i) : indices[i]; };
    const std::size_t before = mesh_.triangles.size(), triangles = triangle_count(primitive.mode, count);
    resize_large(mesh_.triangles, before + triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
      const std::array<std::size_t, 3> at = corners_of(primitive.mode, i);
      mesh_.triangles[before + i] = {index(at[0]), index(at[1]), index(at[2])};
    }
    return {};
  }

  Expected<void> add_positions(int accessor, std::size_t first) {
    Expected<void> read = file_.append(accessor, rest_.positions);
    for (std::size_t i = first; i < rest_.positions.size(); ++i)
      has_unplaced_ |= !is_finite(rest_.positions[i]);
    if (read && in_place_)
      append_large(mesh_.positions, std::span(std::as_const(rest_.positions)).subspan(first));
    else if (read)
      place(rest_.positions, first, mesh_.positions,
            [this](const glm::vec3& p) { return placement_.position(p); });
    return read;
  }

  Expected<void> add_normals(int accessor, std::size_t first, std::size_t count) {
    Expected<void> read = append(accessor, first, count, glm::vec3(0.0f), rest_.normals);
    if (!read) return read;
    resize_large(rest_.normals, first + count);
    if (accessor >= 0) drop_void_normals(first);
    if (in_place_)
      append_large(mesh_.normals, std::span(std::as_const(rest_.normals)).subspan(first));
    else
      place(rest_.normals, first, mesh_.normals, [this](const glm::vec3& n) { return placement_.normal(n); });
    return {};
  }

  Expected<void> add_tangents(int accessor, std::size_t first, std::size_t count) {
    Expected<void> read = append(accessor, first, count, glm::vec4(0.0f), rest_.tangents);
    if (read && !rest_.tangents.empty())
      place(rest_.tangents, first, mesh_.tangents,
            [this](const glm::vec4& t) { return placement_.tangent(t); });
    return read;
  }

  // One for each of the `count` vertices from `first` on, `none` where the primitive has no such attribute.
  // What no primitive has yet stays empty.
  template <class T>
  Expected<void> append(int accessor, std::size_t first, std::size_t count, const T& none,
                        std::vector<T>& to) {
    if (accessor < 0 && to.empty()) return {};
    resize_large(to, first, none);
    if (accessor < 0) {
      resize_large(to, first + count, none);
      return {};
    }
    Expected<void> read = file_.append(accessor, to);
    if (read && to.size() != first + count)
      return file_.error("accessor " + std::to_string(accessor) + " does not hold one element a vertex");
    if (read && item_of(file_.accessors, accessor).component_type == kGltfFloat)
      replace_unfit(to, first, none);
    return read;
  }

  // RGB or RGBA; white where the primitive has none.
  Expected<void> append_colors(int accessor, std::size_t first, std::size_t count) {
    const bool opaque =
        in_range(accessor, file_.accessors) && item_of(file_.accessors, accessor).components == 3;
    if (!opaque) return append(accessor, first, count, glm::vec4(1.0f), mesh_.colors);
    std::vector<glm::vec3> rgb;
    if (const Expected<void> read = file_.append(accessor, rgb); !read) return read;
    if (rgb.size() != count)
      return file_.error("accessor " + std::to_string(accessor) + " does not hold one element a vertex");
    resize_large(mesh_.colors, first, glm::vec4(1.0f));
    for (const glm::vec3& c : rgb) mesh_.colors.emplace_back(c, 1.0f);
    if (item_of(file_.accessors, accessor).component_type == kGltfFloat)
      replace_unfit(mesh_.colors, first, glm::vec4(1.0f));
    return {};
  }

  // Puts `none` in place of values from `first` on that are not finite.
  template <class T>
  void replace_unfit(std::vector<T>& values, std::size_t first, const T& none) {
    for_each_part(values.size() - first, kPlacedAtOnce, [&](std::size_t begin, std::size_t end) {
      std::size_t unfit = 0;
      for (std::size_t i = first + begin; i < first + end; ++i)
        if (!is_finite(values[i])) {
          values[i] = none;
          ++unfit;
        }
      if (unfit > 0) unfit_ += unfit;
    });
  }

  void drop_void_normals(std::size_t first) {
    constexpr float kLeast = 1e-12f;  // squared: what shading takes for none
    for (std::size_t i = first; i < rest_.normals.size(); ++i) {
      if (glm::dot(rest_.normals[i], rest_.normals[i]) > kLeast) continue;
      rest_.normals[i] = glm::vec3(0.0f);
      has_void_normals_ = true;
    }
  }

  // Those from `first` on, as the world sees them.
  template <class T, class PlaceOne>
  void place(const std::vector<T>& rest, std::size_t first, std::vector<T>& to, const PlaceOne& place_one) {
    resize_large(to, rest.size());
    for_each_part(rest.size() - first, kPlacedAtOnce, [&](std::size_t begin, std::size_t end) {
      throw_if_cancelled(file_.progress);
      for (std::size_t i = first + begin; i < first + end; ++i) to[i] = place_one(rest[i]);
    });
  }

  const GltfFile& file_;
  Placement placement_;
  bool in_place_;  // nothing moves
  MeshData& mesh_;
  RestPose& rest_;
  DeformationReader* deformation_;  // null: nothing deforms it
  std::map<Attributes, std::uint32_t> placed_;
  bool has_void_normals_ = false, is_partly_smooth_ = false, has_unplaced_ = false;
  std::size_t first_vertex_ = mesh_.positions.size(), unplaced_ = 0;
  std::atomic<std::size_t> unfit_ = 0;
};

}  // namespace

Expected<void> add_gltf_mesh(const GltfFile& file, int mesh, const glm::mat4& world_from_mesh,
                             std::uint32_t default_material, MeshData& to, RestPose& rest,
                             DeformationReader* deformation, Loading& loading) {
  Warnings& warnings = loading.warnings;
  if (!in_range(mesh, file.meshes)) return file.error("a node names mesh " + which_of(mesh, file.meshes));
  MeshPlacer placer(file, world_from_mesh, to, rest, deformation);
  std::size_t unplaced_strokes = 0;
  const std::vector<GltfPrimitive>& primitives = item_of(file.meshes, mesh).primitives;
  for (const GltfPrimitive& primitive : primitives) {
    PointsAndLines::Kind& strokes =
        primitive.mode == kGltfPoints ? loading.strokes.points : loading.strokes.lines;
    const bool is_stroke = is_stroke_mode(primitive.mode);
    if (is_stroke && !strokes.drawn()) {
      strokes.leave_out("mesh " + std::to_string(mesh));
      continue;
    }
    if (!is_stroke && primitive.mode != kGltfTriangles && primitive.mode != kGltfTriangleStrip &&
        primitive.mode != kGltfTriangleFan)
      return file.error("a primitive has the mode " + std::to_string(primitive.mode) +
                        ", which glTF does not know");
    if (primitive.attribute("POSITION") < 0) {
      warnings.add({file.path.string(), "mesh " + std::to_string(mesh),
                    "primitives without positions are left out", "they are not drawn"});
      continue;
    }
    const Expected<std::size_t> added =
        is_stroke ? add_gltf_strokes(file, primitive, world_from_mesh, default_material, to, rest,
                                     deformation, loading.strokes)
                  : placer.add(primitive, default_material).transform([] { return std::size_t{0}; });
    unplaced_strokes += added.value_or(0);
    if (!added) {
      InputError error = added.error();
      error.what = "mesh " + std::to_string(mesh) + "'s primitive " +
                   std::to_string(&primitive - &primitives.front()) + ": " + error.what;
      return Unexpected(error);
    }
  }
  warn_of_unplaced(file.path.string(), "mesh " + std::to_string(mesh), unplaced_strokes, warnings);
  placer.forget_unplaced();
  if (placer.unplaced() > 0)
    warnings.add(
        {file.path.string(), "mesh " + std::to_string(mesh), kUnplaced, kNotDrawn, placer.unplaced()});
  if (placer.unfit() > 0)
    warnings.add({file.path.string(), "mesh " + std::to_string(mesh), kUnfit, kUnfitLost, placer.unfit()});
  if (placer.is_partly_smooth())
    warnings.add({file.path.string(), "mesh " + std::to_string(mesh), "normals of length 0 are left out",
                  "triangles there are shaded by the normals of their other corners"});
  return {};
}

}  // namespace pinocchio
