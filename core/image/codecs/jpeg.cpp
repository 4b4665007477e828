#include <turbojpeg.h>

#include <memory>

#include "core/image/codecs/decoders.h"

namespace pinocchio {

Expected<DecodedImage> decode_jpeg(const EncodedPicture& picture) {
  const std::unique_ptr<void, int (*)(tjhandle)> context(tjInitDecompress(), tjDestroy);
  const unsigned long size = picture.bytes.size();
  int width = 0, height = 0, subsampling = 0, colors = 0;
  if (!context || tjDecompressHeader3(context.get(), picture.bytes.data(), size, &width, &height,
                                      &subsampling, &colors) != 0)
    return picture.error(std::string("cannot be read as JPEG: ") + tjGetErrorStr2(context.get()));
  Expected<DecodedImage> image = picture.black(width, height);
  if (!image) return image;
  const bool cmyk = colors == TJCS_CMYK || colors == TJCS_YCCK;
  if (tjDecompress2(context.get(), picture.bytes.data(), size, bytes_of(*image).data(), width, 0, height,
                    cmyk ? TJPF_CMYK : TJPF_RGBA, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0) {
    image->damage = tjGetErrorStr2(context.get());
    if (tjGetErrorCode(context.get()) != TJERR_WARNING)
      return picture.error("cannot be read as JPEG: " + image->damage);
  }
  if (cmyk)  // Adobe's: how much of the paper shows
    for (glm::u8vec4& p : image->texture.texels.pixels())
      p = glm::u8vec4(glm::ivec3(p) * int{p.w} / 255, 255);
  return image;
}

}  // namespace pinocchio
