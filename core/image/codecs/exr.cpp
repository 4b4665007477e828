// Reading EXR.
#include "pinocchio/exr.h"

#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfRationalAttribute.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/image/codecs/exr_open.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The methods that we write, in the order of ExrCompression; others are near to the first.
constexpr std::array kImfCompressions{Imf::ZIP_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::PIZ_COMPRESSION,
                                      Imf::RLE_COMPRESSION, Imf::NO_COMPRESSION};

ExrCompression compression_of(Imf::Compression compression) {
  const auto found = std::ranges::find(kImfCompressions, compression);
  return static_cast<ExrCompression>(found == kImfCompressions.end() ? 0 : found - kImfCompressions.begin());
}

glm::mat4 glm_matrix(const Imath::M44f& m) {
  glm::mat4 result(1.0f);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) result[row][column] = m[row][column];
  return result;
}

// A channel's pixels for OpenEXR. The base is the address of pixel (0, 0), which may lie outside the data
// window.
template <class T>
Imf::Slice slice(Imf::PixelType type, const T* pixels, const PixelBox& window) {
  const auto width = static_cast<std::ptrdiff_t>(window.size().x);
  const std::ptrdiff_t to_first = window.lo.y * width + window.lo.x;
  const auto base = reinterpret_cast<std::uintptr_t>(pixels) - to_first * sizeof(T);
  return {type, reinterpret_cast<char*>(base), sizeof(T), sizeof(T) * width};
}

void read_attributes(const Imf::Header& header, ExrFile& exr) {
  for (auto it = header.begin(); it != header.end(); ++it) {
    const Imf::Attribute& attribute = it.attribute();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute))
      exr.attributes[it.name()] = text->value();
    if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&attribute))
      exr.attributes[it.name()] = number->value();
    if (const auto* whole = dynamic_cast<const Imf::IntAttribute*>(&attribute))
      exr.attributes[it.name()] = whole->value();
    if (const auto* ratio = dynamic_cast<const Imf::RationalAttribute*>(&attribute))
      exr.attributes[it.name()] = ExrRational{ratio->value().n, as_int(ratio->value().d)};
    if (const auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(&attribute))
      exr.attributes[it.name()] = glm_matrix(matrix->value());
  }
}

ExrFile read_file(const std::filesystem::path& file, std::uint64_t claim_bytes) {
  const std::unique_ptr<Imf::InputFile> opened = open_exr(file, claim_bytes);
  Imf::InputFile& in = *opened;
  if (!in.isComplete())
    throw std::runtime_error("it ends before its last line");  // checked before memory is allocated
  const Imath::Box2i &display = in.header().displayWindow(), &data = in.header().dataWindow();
  ExrFile exr;
  exr.display_size = {display.max.x - display.min.x + 1, display.max.y - display.min.y + 1};
  exr.data_window = {{data.min.x, data.min.y}, {data.max.x + 1, data.max.y + 1}};
  read_attributes(in.header(), exr);
  exr.compression = compression_of(in.header().compression());

  const Imf::ChannelList& list = in.header().channels();
  for (auto it = list.begin(); it != list.end(); ++it) {
    const Imf::PixelType type = it.channel().type;
    exr.channels.push_back({it.name(),
                            type == Imf::UINT    ? ExrChannel::Type::uint
                            : type == Imf::FLOAT ? ExrChannel::Type::real
                                                 : ExrChannel::Type::half,
                            {},
                            {}});
  }
  const glm::ivec2 size = exr.data_window.size();
  const std::size_t count = size.x * as_size(size.y);
  Imf::FrameBuffer pixels;
  for (ExrChannel& channel : exr.channels) {
    if (channel.type == ExrChannel::Type::uint) {
      channel.uints.resize(count);
      pixels.insert(channel.name, slice(Imf::UINT, channel.uints.data(), exr.data_window));
    } else {
      channel.values.resize(count);
      pixels.insert(channel.name, slice(Imf::FLOAT, channel.values.data(), exr.data_window));
    }
  }
  in.setFrameBuffer(pixels);
  in.readPixels(data.min.y, data.max.y);
  return exr;
}

}  // namespace

const ExrChannel* ExrFile::find(const std::string& name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const ExrChannel& channel) { return channel.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

Expected<ExrFile> read_exr(const std::filesystem::path& file) {
  return read_exr(file, kUsualExrClaim);
}

Expected<ExrFile> read_exr(const std::filesystem::path& file, std::uint64_t claim_bytes) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    return Unexpected(InputError{file.string(), 0, "there is no such file", "check its name"});
  try {
    return read_file(file, claim_bytes);
  } catch (const std::exception& error) {
    return Unexpected(InputError{file.string(), 0, std::string("cannot be read as EXR: ") + error.what(),
                                 "is it damaged, or another format?"});
  }
}

}  // namespace pinocchio
