#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pinocchio {

// A texture statement of an MTL file.
struct MtlTexture {
  std::string file;  // empty: there is none
  glm::vec2 scale{1.0f}, offset{0.0f};
  bool clamp = false;
  float bump = 1.0f;    // -bm
  char channel = '\0';  // -imfchan
};

// A material of an MTL file; names and defaults are MTL's.
struct MtlMaterial {
  std::string name;  // may hold spaces
  glm::vec3 ka{0.0f}, ks{0.0f}, tf{0.0f};
  std::optional<glm::vec3> kd, ke;  // none: their textures are multiplied by a default, not by 0
  float ns = 1.0f, ni = 1.0f, dissolve = 1.0f;
  std::optional<int> illum;
  std::optional<float> metallic, roughness;  // Pm, Pr
  MtlTexture map_kd, map_d, map_ke, map_bump, norm;
};

struct MtlFile {
  std::vector<MtlMaterial> materials;
  // Why its Tr is read as opacity; MTL defines it as transparency. Empty: it is read as MTL defines it.
  std::string opacity_reason;
};

// A material's d takes precedence over its Tr. Some exporters write `Tr 1` for opaque materials: MeshLab
// until 2022, which the file's header names, and others, in whose files nothing would be visible otherwise.
[[nodiscard]] MtlFile read_mtl(std::string_view text);

// What the picture loses without the statement of this keyword, as it is not read. Empty: nothing. None: it
// is no statement of MTL.
[[nodiscard]] std::optional<std::string_view> lost_without(std::string_view keyword);

// Whether read_mtl reads this option of a texture.
[[nodiscard]] bool reads_mtl_option(std::string_view option);

}  // namespace pinocchio
