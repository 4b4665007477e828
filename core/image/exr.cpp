#include "pinocchio/exr.h"

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "core/image/atomic_file.h"

namespace pinocchio {
namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr int kRowsAtOnce = 256;  // many blocks of ZIP's 16 rows, for all threads

Imf::PixelType imf_type(ExrChannel::Type type) {
  switch (type) {
    case ExrChannel::Type::half:
      return Imf::HALF;
    case ExrChannel::Type::real:
      return Imf::FLOAT;
    case ExrChannel::Type::uint:
      return Imf::UINT;
  }
  return Imf::HALF;
}

Imf::Compression imf_compression(ExrCompression compression) {
  switch (compression) {
    case ExrCompression::zip:
      return Imf::ZIP_COMPRESSION;
    case ExrCompression::zips:
      return Imf::ZIPS_COMPRESSION;
    case ExrCompression::piz:
      return Imf::PIZ_COMPRESSION;
    case ExrCompression::rle:
      return Imf::RLE_COMPRESSION;
    case ExrCompression::none:
      return Imf::NO_COMPRESSION;
  }
  return Imf::ZIP_COMPRESSION;
}

half to_half(float value) {
  return half(std::isfinite(value) ? std::clamp(value, -kLargestHalf, kLargestHalf) : value);
}

Imath::M44f imath_matrix(const glm::mat4& m) {
  Imath::M44f result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result[row][column] = m[row][column];  // GLM's columns are its rows
  return result;
}

glm::mat4 glm_matrix(const Imath::M44f& m) {
  glm::mat4 result(1.0f);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) result[row][column] = m[row][column];
  return result;
}

struct InsertAttribute {
  Imf::Header& header;
  const std::string& name;
  void operator()(const std::string& text) const { header.insert(name, Imf::StringAttribute(text)); }
  void operator()(float value) const { header.insert(name, Imf::FloatAttribute(value)); }
  void operator()(const glm::mat4& m) const { header.insert(name, Imf::M44fAttribute(imath_matrix(m))); }
};

Imf::Header header_of(const ExrFile& exr) {
  const Imath::Box2i display(Imath::V2i(0, 0), Imath::V2i(exr.display_size.x - 1, exr.display_size.y - 1));
  const Imath::Box2i data(Imath::V2i(exr.data_window.lo.x, exr.data_window.lo.y),
                          Imath::V2i(exr.data_window.hi.x - 1, exr.data_window.hi.y - 1));
  Imf::Header header(display, data);
  header.compression() = imf_compression(exr.compression);
  Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709
  for (const auto& [name, value] : exr.attributes) std::visit(InsertAttribute{header, name}, value);
  for (const ExrChannel& channel : exr.channels)
    header.channels().insert(channel.name, Imf::Channel(imf_type(channel.type)));
  return header;
}

// Where OpenEXR finds a channel's pixels: its base is that of pixel (0, 0), inside the data window or not.
template <class T>
Imf::Slice slice(Imf::PixelType type, const T* pixels, const PixelBox& window) {
  const auto width = static_cast<std::ptrdiff_t>(window.size().x);
  const std::ptrdiff_t to_first = window.lo.y * width + window.lo.x;
  const auto base =
      reinterpret_cast<std::uintptr_t>(pixels) - static_cast<std::uintptr_t>(to_first) * sizeof(T);
  return {type, reinterpret_cast<char*>(base), sizeof(T), sizeof(T) * static_cast<std::size_t>(width)};
}

void write_file(const std::filesystem::path& file, const ExrFile& exr, Progress* progress) {
  std::vector<std::vector<half>> halves;
  halves.reserve(exr.channels.size());
  Imf::FrameBuffer pixels;
  for (const ExrChannel& channel : exr.channels) {
    switch (channel.type) {
      case ExrChannel::Type::half: {
        std::vector<half>& converted = halves.emplace_back(channel.values.size());
        std::transform(channel.values.begin(), channel.values.end(), converted.begin(), to_half);
        pixels.insert(channel.name, slice(Imf::HALF, converted.data(), exr.data_window));
        break;
      }
      case ExrChannel::Type::real:
        pixels.insert(channel.name, slice(Imf::FLOAT, channel.values.data(), exr.data_window));
        break;
      case ExrChannel::Type::uint:
        pixels.insert(channel.name, slice(Imf::UINT, channel.uints.data(), exr.data_window));
        break;
    }
  }
  // OutputFile's destructor swallows a failure to write the last bytes: the stream is ours, to ask it.
  std::ofstream stream(file, std::ios::binary);
  {
    Imf::StdOFStream to(stream, file.c_str());
    Imf::OutputFile out(to, header_of(exr));
    out.setFrameBuffer(pixels);
    const int rows = exr.data_window.size().y;
    begin_phase(progress, "write", rows);
    for (int y = 0; y < rows; y += kRowsAtOnce) {
      const int count = std::min(kRowsAtOnce, rows - y);
      out.writePixels(count);
      advance(progress, count);
    }
  }
  if (!stream.flush()) throw std::runtime_error("is the disk full?");
}

void read_attributes(const Imf::Header& header, ExrFile& exr) {
  for (auto it = header.begin(); it != header.end(); ++it) {
    const Imf::Attribute& attribute = it.attribute();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute))
      exr.attributes[it.name()] = text->value();
    if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&attribute))
      exr.attributes[it.name()] = number->value();
    if (const auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(&attribute))
      exr.attributes[it.name()] = glm_matrix(matrix->value());
  }
}

// A damaged header may speak of more pixels than there is memory for; no file of this size holds them.
void check_plausible(const Imf::Header& header, std::uintmax_t file_bytes) {
  constexpr double kAlwaysRead = 1024.0 * 1024.0 * 1024.0;  // bytes
  constexpr double kMostPacked = 2048.0;                    // deflate stays below 1032
  const Imath::Box2i& data = header.dataWindow();
  const double pixels = (static_cast<double>(data.max.x) - data.min.x + 1.0) *
                        (static_cast<double>(data.max.y) - data.min.y + 1.0);
  double bytes = 0.0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) bytes += 4.0 * pixels;
  if (bytes > kAlwaysRead && bytes > kMostPacked * static_cast<double>(file_bytes))
    throw std::runtime_error("its header speaks of more pixels than the file can hold");
}

ExrFile read_file(const std::filesystem::path& file) {
  Imf::InputFile in(file.c_str());
  check_plausible(in.header(), std::filesystem::file_size(file));
  const Imath::Box2i &display = in.header().displayWindow(), &data = in.header().dataWindow();
  ExrFile exr;
  exr.display_size = {display.max.x - display.min.x + 1, display.max.y - display.min.y + 1};
  exr.data_window = {{data.min.x, data.min.y}, {data.max.x + 1, data.max.y + 1}};
  read_attributes(in.header(), exr);

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
  const std::size_t count = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
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

void write_exr(const std::filesystem::path& file, const ExrFile& exr, Progress* progress) {
  check_writable(file);
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    try {
      write_file(temporary, exr, progress);
    } catch (const Cancelled&) {
      throw;
    } catch (const std::exception& error) {
      throw EnvironmentError(file.string() + ": cannot be written: " + error.what());
    }
  });
}

Expected<ExrFile> read_exr(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    return Unexpected(InputError{file.string(), 0, "there is no such file", "check its name"});
  try {
    return read_file(file);
  } catch (const std::exception& error) {
    return Unexpected(InputError{file.string(), 0, std::string("cannot be read as EXR: ") + error.what(),
                                 "is it damaged, or another format?"});
  }
}

}  // namespace pinocchio
