#include "pinocchio/load.h"

#include <algorithm>
#include <cmath>

#include "core/base/listed.h"
#include "core/files/input_file.h"
#include "core/math/finite.h"
#include "core/parallel/parts.h"
#include "core/scene/formats.h"
#include "core/scene/up_axis.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr std::size_t kMostVertices = 0xffffffffu;  // indices have 32 bits

Unexpected error(const std::filesystem::path& path, const std::string& what, const std::string& remedy) {
  return Unexpected(InputError{path.string(), 0, what, remedy});
}

// scenes/cornell -> scenes/cornell.gltf, scenes/cornell/ -> scenes/cornell/cornell.gltf
Expected<std::filesystem::path> find_scene_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_directory(status)) return path;
  const std::filesystem::path trimmed = path.has_filename() ? path : path.parent_path();
  for (const std::filesystem::path& stem : {trimmed, trimmed / trimmed.filename()})
    for (const SceneFormat& format : scene_formats())
      for (const std::string_view extension : format.extensions)
        if (std::filesystem::path file = stem.string().append(extension);
            !extension.empty() && std::filesystem::is_regular_file(file, ignored))
          return file;
  if (std::filesystem::is_directory(path, ignored))
    return error(path, "is a folder without a scene of that name",
                 "name a " + scene_extensions(FormatUse::read) + " file in it");
  const auto [what, remedy] = absence_of(path);
  return error(path, what, remedy);
}

template <class T>
bool one_each_or_none(const std::vector<T>& of_vertices, const Mesh& mesh) {
  return of_vertices.empty() || of_vertices.size() == mesh.positions.size();
}

bool names_known_textures(const MaterialMaps& m, const Mesh& mesh) {
  const auto known = [&](const TextureUse* use) { return use->texture < as_int(mesh.textures.size()); };
  return std::ranges::all_of(m.uses(), known);
}

// Points and lines that the file holds and nothing draws: a warning each, or an error where it holds nothing
// else.
Expected<void> judge_left_out(const std::string& file, const PointsAndLines& strokes, bool is_empty,
                              Warnings& warnings) {
  std::vector<std::string> names, options;
  const auto note = [&](const PointsAndLines::Kind& kind, const char* name, const char* option) {
    if (kind.left_out == 0) return;
    names.emplace_back(name);
    options.push_back(std::string(option) + " D");
  };
  note(strokes.points, "points", "--point-size");
  note(strokes.lines, "lines", "--line-width");
  const auto warn = [&](const PointsAndLines::Kind& kind, const char* what, const char* lost) {
    if (kind.left_out > 0) warnings.add({file, kind.left_out_at, what, lost, kind.left_out});
  };
  if (is_empty && !names.empty())
    return error(file, "holds no triangles, only " + listed(names, ", ", " and "),
                 "draw them with " + listed(options, ", ", " and ") + ", a diameter in scene units");
  warn(strokes.points, "points are left out", "they are not drawn; --point-size draws them");
  warn(strokes.lines, "lines are left out", "they are not drawn; --line-width draws them");
  return {};
}

}  // namespace

Expected<Scene> load_scene(const std::filesystem::path& path, Warnings* warnings, Progress* progress,
                           std::uint64_t limit_bytes) {
  return load_scene(path, LoadOptions{limit_bytes, false}, warnings, progress);
}

Expected<Scene> load_scene(const std::filesystem::path& path, const LoadOptions& options, Warnings* warnings,
                           Progress* progress) {
  const Expected<std::filesystem::path> file = find_scene_file(path);
  if (!file) return Unexpected(file.error());
  std::error_code ignored;
  if (std::filesystem::is_regular_file(*file, ignored) && std::filesystem::file_size(*file, ignored) == 0)
    return error(*file, "is empty", "is the export complete?");
  Warnings own;  // dropped where the scene is refused: the error is then its only line
  Warnings& heard = options.confine || !warnings ? own : *warnings;
  MemoryLimit limit(options.limit_bytes);
  InputFiles files(*file, options.confine);
  Loading loading{heard, progress, limit, files, options};
  loading.strokes.points.diameter = options.point_size;
  loading.strokes.lines.diameter = options.line_width;
  const SceneFormat* const format = find_scene_format(*file);
  if (!format)
    return error(*file, "is not of a format that can be read",
                 "convert it to " + scene_extensions(FormatUse::read));
  Expected<Scene> scene = format->load(*file, loading);
  const Expected<void> left_out = judge_left_out(file->string(), loading.strokes,
                                                 scene && scene->mesh->triangles.empty(), loading.warnings);
  if (const std::optional<InputError> outside = files.error()) return Unexpected(*outside);
  if (warnings && &heard != warnings)
    for (const Warning& warning : own) warnings->add(warning);
  if (limit.error()) return Unexpected(*limit.error());
  if (!scene) return scene;
  if (!left_out) return Unexpected(left_out.error());
  if (!options.variant.empty() && scene->variants.empty())
    return error(*file, "has no variants of its materials, and none named '" + options.variant + "'",
                 "leave out the choice of a variant");
  if (!options.animation.empty() && !scene->animation)
    return error(*file, "has no animation '" + options.animation + "'",
                 "leave out the choice of an animation");
  if (options.up_axis == UpAxis::z) scene = turned_up(std::move(*scene));
  if (!scene) return scene;
  scene->source = file->string();
  scene->source_files.insert(scene->source_files.begin(), scene->source);
  if (const Expected<void> checked = check_scene(*scene); !checked) return Unexpected(checked.error());
  return scene;
}

namespace {

constexpr char kExportAgain[] = "export it again";

// Not too many, and an entry of each array for each vertex or triangle.
Expected<void> check_sizes(const std::string& file, const Mesh& mesh) {
  const auto over = [&](std::size_t n, const char* what, std::size_t most) {
    return error(file, "holds " + std::to_string(n) + what + ", the limit is " + std::to_string(most),
                 "split it");
  };
  if (mesh.triangles.empty()) return error(file, "holds no triangles", "there is nothing to draw");
  if (mesh.triangles.size() > kMaxTriangles) return over(mesh.triangles.size(), " triangles", kMaxTriangles);
  if (mesh.positions.size() > kMostVertices) return over(mesh.positions.size(), " vertices", kMostVertices);
  if (mesh.normals.size() != mesh.positions.size() ||
      mesh.triangle_materials.size() != mesh.triangles.size() || !one_each_or_none(mesh.texcoords, mesh) ||
      !one_each_or_none(mesh.texcoords1, mesh) || !one_each_or_none(mesh.colors, mesh) ||
      !one_each_or_none(mesh.tangents, mesh))
    return error(file, "its arrays do not have one entry for each vertex or triangle", kExportAgain);
  return {};
}

Expected<void> check_numbers(const std::string& file, const Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  const auto check = [&](const std::string& what, std::size_t n, const auto& is_sound) -> Expected<void> {
    const std::size_t bad = first_where(n, [&](std::size_t i) { return !is_sound(i); });
    if (bad == n) return {};
    return error(file, what + std::to_string(bad) + " is not a finite number", kExportAgain);
  };
  const auto all_of = [](const auto& values) {
    return [&values](std::size_t i) { return is_finite(values[i]); };
  };
  Expected<void> checked = check("vertex ", vertices, [&](std::size_t i) {
    return is_finite(mesh.positions[i]) && is_finite(mesh.normals[i]);
  });
  if (!checked) return checked;
  const std::size_t far = first_where(vertices, [&](std::size_t i) {
    const glm::vec3 p = glm::abs(mesh.positions[i]);
    return std::max({p.x, p.y, p.z}) > kFarthest;
  });
  if (far < vertices)
    return error(file, "vertex " + std::to_string(far) + " is more than 1e9 from the origin",
                 "scale the scene down");
  for (const std::vector<glm::vec2>* texcoords : {&mesh.texcoords, &mesh.texcoords1})
    if (checked = check("the texture coordinate of vertex ", texcoords->size(), all_of(*texcoords)); !checked)
      return checked;
  if (checked = check("the colour of vertex ", mesh.colors.size(), all_of(mesh.colors)); !checked)
    return checked;
  return check("the tangent of vertex ", mesh.tangents.size(), all_of(mesh.tangents));
}

// An error if a material or triangle refers to something that the mesh lacks.
Expected<void> check_references(const std::string& file, const Mesh& mesh) {
  for (const Material& m : mesh.materials)
    if (m.maps >= as_int(mesh.maps.size()))
      return error(file, "material '" + m.name + "' names texture maps that do not exist", kExportAgain);
  if (!std::all_of(mesh.maps.begin(), mesh.maps.end(),
                   [&](const auto& m) { return names_known_textures(m, mesh); }))
    return error(file, "a material names a texture that does not exist", kExportAgain);
  const std::size_t lost = first_where(mesh.triangles.size(), [&](std::size_t i) {
    const glm::uvec3& t = mesh.triangles[i];
    return std::max({t.x, t.y, t.z}) >= mesh.positions.size() ||
           mesh.triangle_materials[i] >= mesh.materials.size();
  });
  if (lost < mesh.triangles.size())
    return error(file, "triangle " + std::to_string(lost) + " names a vertex or material that does not exist",
                 kExportAgain);
  return {};
}

}  // namespace

Expected<void> check_scene(const Scene& scene) {
  for (const auto check : {check_sizes, check_numbers, check_references})
    if (Expected<void> checked = check(scene.source, *scene.mesh); !checked) return checked;
  return {};
}

}  // namespace pinocchio
