#include "core/image/codecs/texture_file.h"

#include "core/image/codecs/formats.h"
#include "core/parallel/workers.h"

namespace pinocchio {
namespace {

Expected<DecodedImage> decode(const EncodedImage& image, Progress* progress, Loading& loading) {
  if (image.bytes) return decode_texture({image.file, image.name, *image.bytes, loading.limit});
  const Expected<FileBytes> bytes = loading.files.read(image.file, progress);
  if (!bytes) return Unexpected(bytes.error());
  return decode_texture({image.file, image.name, bytes->unsigned_bytes(), loading.limit});
}

}  // namespace

Expected<DecodedImage> load_texture(const std::filesystem::path& file, Loading& loading) {
  return decode({file.string(), file.filename().string(), std::nullopt}, loading.progress, loading);
}

std::vector<Expected<DecodedImage>> decode_textures(const std::vector<EncodedImage>& images,
                                                    Loading& loading) {
  std::vector<Expected<DecodedImage>> decoded(images.size(), DecodedImage{});
  if (images.empty()) return decoded;
  begin_phase(loading.progress, "images", images.size());
  Workers workers(images.size() > 1 ? 0 : 1);
  workers.for_each(images.size(), [&](std::size_t i) {
    decoded[i] = decode(images[i], nullptr, loading);
    advance(loading.progress);
  });
  return decoded;
}

}  // namespace pinocchio
