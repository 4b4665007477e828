#include "core/scene/save_texture.h"

#include "core/image/png.h"

namespace pinocchio {

std::string png_of(const Texture& texture) {
  return encode_png(texture.texels.size(), 4, std::as_bytes(texture.texels.pixels()));
}

}  // namespace pinocchio
