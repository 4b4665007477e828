// Reading an EXR of all directions: in latitude and longitude, or as the faces of a cube.
#include <ImfChannelList.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/image/codecs/decoders.h"
#include "core/image/codecs/exr_open.h"
#include "core/image/cube_map.h"

namespace pinocchio {
namespace {

Unexpected refuse(const EncodedPicture& picture, const std::string& what, const std::string& remedy) {
  return Unexpected(InputError{picture.file, 0, what, remedy});
}

// The channels of a colour: R, G and B, or Y three times. Empty: there are none.
std::array<std::string, 3> color_channels(const Imf::ChannelList& list) {
  const auto there = [&list](const char* name) {
    const Imf::Channel* const channel = list.findChannel(name);
    return channel && channel->xSampling == 1 && channel->ySampling == 1;
  };
  if (there("R") && there("G") && there("B")) return {"R", "G", "B"};
  if (there("Y")) return {"Y", "Y", "Y"};
  return {};
}

// Luminance Y for each pixel, chroma RY and BY for each four.
bool is_luminance_chroma(const Imf::ChannelList& list) {
  const bool has_rgb = list.findChannel("R") && list.findChannel("G") && list.findChannel("B");
  return !has_rgb && list.findChannel("Y") && (list.findChannel("RY") || list.findChannel("BY"));
}

void read_channels(Imf::InputFile& in, const std::array<std::string, 3>& channels, Image<glm::vec3>& image) {
  const Imath::Box2i& data = in.header().dataWindow();
  const std::size_t row = image.width() * sizeof(glm::vec3);
  const auto first = reinterpret_cast<std::uintptr_t>(image.pixels().data()) -
                     static_cast<std::uintptr_t>(std::int64_t{data.min.y} * static_cast<std::int64_t>(row) +
                                                 std::int64_t{data.min.x} * std::int64_t{sizeof(glm::vec3)});
  Imf::FrameBuffer pixels;
  for (std::size_t c = 0; c < 3 && (c == 0 || channels[c] != channels[0]); ++c)
    pixels.insert(channels[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first + c * sizeof(float)),
                                          sizeof(glm::vec3), row));
  in.setFrameBuffer(pixels);
  in.readPixels(data.min.y, data.max.y);
  if (channels[1] == channels[0])
    for (glm::vec3& c : image.pixels()) c = glm::vec3(c.x);
}

// OpenEXR converts luminance and chroma to RGB.
void read_luminance_chroma(const std::string& file, Image<glm::vec3>& image) {
  Imf::RgbaInputFile in(file.c_str());
  const Imath::Box2i& data = in.dataWindow();
  std::vector<Imf::Rgba> line(image.width());
  const auto first = reinterpret_cast<std::uintptr_t>(line.data()) -
                     static_cast<std::uintptr_t>(std::int64_t{data.min.x} * std::int64_t{sizeof(Imf::Rgba)});
  in.setFrameBuffer(reinterpret_cast<Imf::Rgba*>(first), 1, 0);
  for (int y = 0; y < image.height(); ++y) {
    in.readPixels(data.min.y + y);
    std::ranges::transform(line, &image.at(0, y),
                           [](const Imf::Rgba& p) { return glm::vec3(p.r, p.g, p.b); });
  }
}

// OpenEXR's cube maps are six faces, one above another. Their outer pixels lie on the cube's edges, so
// nothing is interpolated across the edges.
Image<glm::vec3> lat_long_of_faces(const Image<glm::vec3>& faces) {
  const Imath::Box2i window({0, 0}, {faces.width() - 1, faces.height() - 1});
  const int last = faces.width() - 1;
  return lat_long_of(faces.width(), [&](const glm::vec3& direction) {
    Imf::CubeMapFace face{};
    Imath::V2f at;
    Imf::CubeMap::faceAndPixelPosition({direction.x, direction.y, direction.z}, window, face, at);
    const auto texel = [&](int x, int y) -> const glm::vec3& {
      const Imath::V2f place(std::clamp(x, 0, last), std::clamp(y, 0, last));
      const Imath::V2f pixel = Imf::CubeMap::pixelPosition(face, window, place);
      return faces.at(pixel.x, pixel.y);
    };
    const glm::ivec2 low(std::floor(at.x), std::floor(at.y));
    const glm::vec2 f = glm::vec2(at.x, at.y) - glm::vec2(low);
    return glm::mix(glm::mix(texel(low.x, low.y), texel(low.x + 1, low.y), f.x),
                    glm::mix(texel(low.x, low.y + 1), texel(low.x + 1, low.y + 1), f.x), f.y);
  });
}

}  // namespace

Expected<Image<glm::vec3>> decode_exr_light(const EncodedPicture& picture) try {
  const std::unique_ptr<Imf::InputFile> opened =
      open_exr(picture.file, std::min(kUsualExrClaim, picture.limit.bytes()));
  Imf::InputFile& in = *opened;
  const std::array<std::string, 3> channels = color_channels(in.header().channels());
  const bool chroma = is_luminance_chroma(in.header().channels());
  if (channels[0].empty() && !chroma)
    return refuse(picture, "has no channels R, G and B, nor Y", "write it as an RGB picture");
  const Imath::Box2i& data = in.header().dataWindow();
  const std::uint64_t width = std::int64_t{data.max.x} - data.min.x + 1,
                      height = std::int64_t{data.max.y} - data.min.y + 1;
  constexpr std::uint64_t kMostSide = 1 << 20;
  if (width > kMostSide || height > kMostSide)
    return refuse(picture, "has an impossible size", "is it damaged?");
  const bool is_cube = Imf::hasEnvmap(in.header()) && Imf::envmap(in.header()) == Imf::ENVMAP_CUBE;
  if (is_cube && height != 6 * width)
    return refuse(picture, "is a cube map (envmap) whose faces are not six squares, one above another",
                  "write it in latitude and longitude");
  // The picture, and the sums of light that are made from it later.
  const std::uint64_t pixels = is_cube ? width * height + 8 * width * width : width * height;
  if (!picture.limit.take(picture.file, "the environment", pixels, sizeof(glm::vec3) + sizeof(float)))
    return Unexpected(*picture.limit.error());
  Image<glm::vec3> image(glm::ivec2(width, height));
  if (chroma)
    read_luminance_chroma(picture.file, image);
  else
    read_channels(in, channels, image);
  if (is_cube) return lat_long_of_faces(image);
  return image;
} catch (const std::exception& error) {
  return refuse(picture, std::string("cannot be read as EXR: ") + error.what(), "is it damaged?");
}

}  // namespace pinocchio
