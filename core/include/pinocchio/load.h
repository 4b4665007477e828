#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pinocchio/error.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A feature of a file that the picture ignores. There is one warning for each feature and file.
struct Warning {
  std::string file;        // the file with the feature
  std::string where;       // the first place: "material 'paint'", "line 12"; empty: the whole file
  std::string what;        // "its normal texture is left out"
  std::string lost;        // the effect on the picture
  std::size_t places = 1;  // the number of places with it

  // One line.
  [[nodiscard]] std::string message() const;
};

class Warnings {
 public:
  // Adds the warning, or counts one more place if the file's feature has one already.
  void add(Warning warning);

  [[nodiscard]] bool empty() const { return all_.empty(); }
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] const Warning& operator[](std::size_t i) const { return all_[i]; }
  [[nodiscard]] auto begin() const { return all_.begin(); }
  [[nodiscard]] auto end() const { return all_.end(); }

 private:
  std::vector<Warning> all_;
  std::map<std::pair<std::string, std::string>, std::size_t> known_;  // by `file` and `what`
};

// The reflection model of a scene's materials: each file's own (glTF's for its metallic-roughness materials,
// else Phong's), or Phong's for all.
enum class Shading : std::uint8_t { from_file, phong };
inline constexpr std::array<std::string_view, 2> kShadingNames{"auto", "phong"};

// The axis of a file's coordinates that points up. Scenes have Y up: with z, the file's (x, y, z) is the
// scene's (x, z, -y).
enum class UpAxis : std::uint8_t { y, z };
inline constexpr std::array<std::string_view, 2> kUpAxisNames{"y", "z"};

// How the files of a scene are read, and how far they are trusted.
struct LoadOptions {
  std::uint64_t limit_bytes = kUsualLoadLimit;  // the most memory that they may claim beyond their own size
  // Opens files that the scene's file names only if they are below its folder, after `..`, absolute names and
  // links are followed. A file elsewhere is an error.
  bool confine = false;
  Shading shading = Shading::from_file;
  // The name or the number of the file's animation that the scene plays. Empty: all of them, together.
  std::string animation{};
  UpAxis up_axis = UpAxis::y;
  // Diameters, in scene units, of the balls and tubes that draw the file's points and lines. 0: they are left
  // out, which is a warning; of a file that holds nothing else, an error.
  float point_size = 0.0f, line_width = 0.0f;
  // The name of one of the file's variants of its materials (Scene::variants). Empty: those that the file
  // shows first.
  std::string variant{};
};

// Reads glTF 2.0 (.gltf, .glb), Wavefront OBJ+MTL (.obj), PLY (.ply) or STL (.stl), chosen by the file's
// extension. A path without extension, or a folder, means the one scene file of that name (scenes/cornell ->
// scenes/cornell.gltf). The result has passed check_scene. Errors name the file and, for text formats, the
// line. Features that a picture can do without are added to `warnings`, which are complete even if the result
// is an error. Throws std::bad_alloc where there is no memory. Phases "read" and "mesh". Any thread.
[[nodiscard]] Expected<Scene> load_scene(const std::filesystem::path& path, Warnings* warnings = nullptr,
                                         Progress* progress = nullptr,
                                         std::uint64_t limit_bytes = kUsualLoadLimit);
[[nodiscard]] Expected<Scene> load_scene(const std::filesystem::path& path, const LoadOptions& options,
                                         Warnings* warnings = nullptr, Progress* progress = nullptr);

// Checks what the rest of the library relies on: 1 to kMaxTriangles triangles, indices and materials in
// range, finite positions within kFarthest, and a finite normal (and texture coordinate) for each position.
inline constexpr float kFarthest =
    1e9f;  // the largest coordinate: beyond it, areas overflow single precision
[[nodiscard]] Expected<void> check_scene(const Scene& scene);

}  // namespace pinocchio
