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

// A material as its MTL file says it; names and defaults are MTL's.
struct MtlMaterial {
  std::string name;  // may hold spaces
  glm::vec3 ka{0.0f}, ks{0.0f}, tf{0.0f};
  std::optional<glm::vec3> kd, ke;  // not said: what their textures are multiplied by is not 0
  float ns = 1.0f, ni = 1.0f, dissolve = 1.0f;
  int illum = 0;
  std::optional<float> metallic, roughness;  // Pm, Pr
  MtlTexture map_kd, map_d, map_ke, map_bump, norm;
};

struct MtlFile {
  std::vector<MtlMaterial> materials;
  // Why its Tr is read as opacity, the opposite of what MTL means by it. Empty: it is not.
  std::string opacity_reason;
};

// A material's d counts before its Tr. Some exporters write `Tr 1` for what is opaque: MeshLab until 2022,
// which its header names, and others, whose files hold nothing visible otherwise.
[[nodiscard]] MtlFile read_mtl(std::string_view text);

// Whether read_mtl reads this option of a texture.
[[nodiscard]] bool reads_mtl_option(std::string_view option);

}  // namespace pinocchio
