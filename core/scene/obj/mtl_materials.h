#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/formats.h"
#include "core/scene/obj/mtl.h"

namespace pinocchio {

// Converts MTL's materials, with maps and textures, one by one. `mesh` already has its texture coordinates.
class MtlMaterials {
 public:
  // Textures are searched for beside `file`.
  MtlMaterials(const std::filesystem::path& file, MeshData& mesh, Loading& loading)
      : file_(file), mesh_(mesh), loading_(loading) {}

  [[nodiscard]] Material make(const MtlMaterial& m);
  // Textures that the file names, found or not.
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

 private:
  enum class Kind { as_it_is, alpha, bump };
  struct Loaded {
    std::string key;
    int texture, channel;
  };

  [[nodiscard]] TextureUse use(const MtlMaterial& m, const MtlTexture& texture, Kind kind,
                               int* channel = nullptr);
  [[nodiscard]] Loaded load(const MtlMaterial& m, const MtlTexture& texture, Kind kind);

  const std::filesystem::path& file_;
  MeshData& mesh_;
  Loading& loading_;
  std::vector<std::string> files_;
  std::vector<Loaded> loaded_;
};

}  // namespace pinocchio
