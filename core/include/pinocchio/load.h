#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pinocchio/error.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// What of a file does not reach the picture: one for each feature and file, however many places have it.
struct Warning {
  std::string file;        // that holds it
  std::string where;       // the first place: "material 'paint'", "line 12"; empty: all of it
  std::string what;        // "its normal texture is left out"
  std::string lost;        // what the picture loses by it
  std::size_t places = 1;  // that have it

  // One clear line.
  [[nodiscard]] std::string message() const;
};

class Warnings {
 public:
  // Where the file's feature is known already, one place more of it.
  void add(Warning warning);

  [[nodiscard]] bool empty() const { return all_.empty(); }
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] const Warning& operator[](std::size_t i) const { return all_[i]; }
  [[nodiscard]] auto begin() const { return all_.begin(); }
  [[nodiscard]] auto end() const { return all_.end(); }

 private:
  std::vector<Warning> all_;
  std::map<std::pair<std::string, std::string>, std::size_t> known_;  // by file and what
};

// How far a scene's files are trusted.
struct LoadOptions {
  std::uint64_t limit_bytes = kUsualLoadLimit;  // most memory that they claim beyond their own bytes
  // Whether files that the scene's file names are opened only below its folder, wherever `..`, absolute names
  // and links lead. One elsewhere is an error.
  bool confine = false;
};

// Reads glTF 2.0 (.gltf, .glb), Wavefront OBJ+MTL (.obj) or PLY (.ply), chosen by the file's extension. A
// path without extension, or a folder, stands for the one scene file of that name (scenes/cornell ->
// scenes/cornell.gltf). The result has passed check_scene. Errors name the file and, for text formats,
// the line; what a picture can do without is added to `warnings` instead, which are whole where the result
// is an error, too. Throws
// std::bad_alloc where there is no memory. Phases "read" and "mesh". Any thread.
[[nodiscard]] Expected<Scene> load_scene(const std::filesystem::path& path, Warnings* warnings = nullptr,
                                         Progress* progress = nullptr,
                                         std::uint64_t limit_bytes = kUsualLoadLimit);
[[nodiscard]] Expected<Scene> load_scene(const std::filesystem::path& path, const LoadOptions& options,
                                         Warnings* warnings = nullptr, Progress* progress = nullptr);

// What the rest of the program relies on: at least one triangle, at most kMaxTriangles, indices and
// materials in range, finite positions within kFarthest, a finite normal (and texture coordinate) a position.
inline constexpr float kFarthest = 1e9f;  // of a coordinate: beyond, areas overflow single precision
[[nodiscard]] Expected<void> check_scene(const Scene& scene);

}  // namespace pinocchio
