// Writing EXR. We make the lines and pack ZIP; OpenEXR writes header and chunks and packs the other methods.
#include <half.h>
#include <openexr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <stdexcept>

#include "core/files/atomic_file.h"
#include "core/image/codecs/exr_bands.h"
#include "core/image/codecs/exr_pack.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr int kPart = 0;

// OpenEXR's last error message on this thread.
thread_local std::string complaint;

void keep_complaint(exr_const_context_t, exr_result_t, const char* message) {
  complaint = message;
}

void check(exr_result_t result) {
  if (result == EXR_ERR_SUCCESS) return;
  throw std::runtime_error(complaint.empty() ? exr_get_default_error_message(result) : complaint);
}

// In the order of ExrCompression and of ExrChannel::Type.
constexpr std::array kExrCompressions{EXR_COMPRESSION_ZIP, EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_PIZ,
                                      EXR_COMPRESSION_RLE, EXR_COMPRESSION_NONE};
constexpr std::array kExrTypes{EXR_PIXEL_HALF, EXR_PIXEL_FLOAT, EXR_PIXEL_UINT};

// An EXR that is being written.
struct Context {
  exr_context_t exr = nullptr;
  std::mutex mutex;  // guards the chunks that are ready and the writing in their order
  std::map<int, std::vector<std::byte>> ready{};
  int next = 0;

  explicit Context(const std::filesystem::path& file) {
    complaint.clear();
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = keep_complaint;
    check(exr_start_write(&exr, file.c_str(), EXR_WRITE_FILE_DIRECTLY, &how));
  }
  ~Context() {
    if (exr) exr_finish(&exr);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

struct SetAttribute {
  exr_context_t exr;
  const char* name;
  void operator()(const std::string& text) const {
    check(exr_attr_set_string(exr, kPart, name, text.c_str()));
  }
  void operator()(float value) const { check(exr_attr_set_float(exr, kPart, name, value)); }
  void operator()(int value) const { check(exr_attr_set_int(exr, kPart, name, value)); }
  void operator()(const ExrRational& value) const {
    const exr_attr_rational_t rational{value.numerator, as_uint32(value.denominator)};
    check(exr_attr_set_rational(exr, kPart, name, &rational));
  }
  void operator()(const glm::mat4& m) const {
    exr_attr_m44f_t rows{};  // GLM's columns are OpenEXR's rows
    std::memcpy(rows.m, &m[0][0], sizeof rows.m);
    check(exr_attr_set_m44f(exr, kPart, name, &rows));
  }
};

void write_header(exr_context_t exr, const ExrFile& file) {
  int part = 0;
  check(exr_add_part(exr, nullptr, EXR_STORAGE_SCANLINE, &part));
  const exr_attr_box2i_t display{{0, 0}, {file.display_size.x - 1, file.display_size.y - 1}};
  const PixelBox& box = file.data_window;
  const exr_attr_box2i_t data{{box.lo.x, box.lo.y}, {box.hi.x - 1, box.hi.y - 1}};
  const exr_attr_v2f_t center{0.0f, 0.0f};
  check(exr_initialize_required_attr(exr, kPart, &display, &data, 1.0f, &center, 1.0f,
                                     EXR_LINEORDER_INCREASING_Y,
                                     kExrCompressions[as_size(file.compression)]));
  const exr_attr_chromaticities_t rec709{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  check(exr_attr_set_chromaticities(exr, kPart, "chromaticities", &rec709));
  for (const auto& [name, value] : file.attributes) std::visit(SetAttribute{exr, name.c_str()}, value);
  for (const ExrChannel& channel : file.channels)
    check(exr_add_channel(exr, kPart, channel.name.c_str(), kExrTypes[as_size(channel.type)],
                          EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
  check(exr_write_header(exr));
}

std::uint16_t half_bits(float value) {
  return half(std::isfinite(value) ? std::clamp(value, -kLargestHalf, kLargestHalf) : value).bits();
}

// Line after line, with the channels of a line in the order of names.
std::vector<std::byte> lines_of(std::vector<ExrChannel> channels, int width, int height) {
  std::ranges::sort(channels, {}, &ExrChannel::name);
  const auto w = as_size(width);
  std::size_t bytes_of_pixel = 0;
  for (const ExrChannel& channel : channels)
    bytes_of_pixel += channel.type == ExrChannel::Type::half ? sizeof(std::uint16_t) : sizeof(float);
  std::vector<std::byte> bytes(bytes_of_pixel * w * height);
  std::vector<std::uint16_t> halves(w);
  std::byte* to = bytes.data();
  const auto put = [&to](const void* from, std::size_t size) {
    std::memcpy(to, from, size);
    to += size;
  };
  for (std::size_t first = 0; first < w * height; first += w)
    for (const ExrChannel& channel : channels) {
      if (channel.type == ExrChannel::Type::uint) {
        put(channel.uints.data() + first, w * sizeof(std::uint32_t));
      } else if (channel.type == ExrChannel::Type::real) {
        put(channel.values.data() + first, w * sizeof(float));
      } else {
        std::transform(channel.values.data() + first, channel.values.data() + first + w, halves.begin(),
                       half_bits);
        put(halves.data(), w * sizeof(std::uint16_t));
      }
    }
  return bytes;
}

// For a pipeline whose lines already have the file's layout.
exr_result_t take_lines(exr_encode_pipeline_t* pipeline) {
  const auto& lines = *static_cast<const std::vector<std::byte>*>(pipeline->encoding_user_data);
  std::memcpy(pipeline->packed_buffer, lines.data(), lines.size());
  pipeline->packed_bytes = lines.size();
  return EXR_ERR_SUCCESS;
}

// Packs with OpenEXR's own routines.
std::vector<std::byte> packed_by_openexr(exr_context_t exr, int y, std::vector<std::byte> lines) {
  exr_chunk_info_t chunk{};
  check(exr_write_scanline_chunk_info(exr, kPart, y, &chunk));
  exr_encode_pipeline_t pipeline EXR_ENCODE_PIPELINE_INITIALIZER;
  check(exr_encoding_initialize(exr, kPart, &chunk, &pipeline));
  for (int c = 0; c < pipeline.channel_count; ++c)  // no channel is empty
    pipeline.channels[c].encode_from_ptr = reinterpret_cast<const std::uint8_t*>(lines.data());
  exr_result_t result = exr_encoding_choose_default_routines(exr, kPart, &pipeline);
  pipeline.convert_and_pack_fn = take_lines;
  pipeline.encoding_user_data = &lines;
  pipeline.yield_until_ready_fn = nullptr;
  pipeline.write_fn = nullptr;
  if (result == EXR_ERR_SUCCESS) result = exr_encoding_run(exr, kPart, &pipeline);
  const auto* const packed = static_cast<const std::byte*>(pipeline.compressed_buffer);
  if (result == EXR_ERR_SUCCESS && packed && pipeline.compressed_bytes < lines.size())
    lines.assign(packed, packed + pipeline.compressed_bytes);
  exr_encoding_destroy(exr, &pipeline);
  check(result);
  return lines;
}

// Writes the chunk after all chunks before it.
void put_chunk(Context& to, const ExrFile& file, int lines_of_chunk, int i, std::vector<std::byte> bytes) {
  const std::lock_guard lock(to.mutex);
  to.ready.emplace(i, std::move(bytes));
  for (auto first = to.ready.begin(); first != to.ready.end() && first->first == to.next;
       first = to.ready.begin()) {
    check(exr_write_scanline_chunk(to.exr, kPart, file.data_window.lo.y + first->first * lines_of_chunk,
                                   first->second.data(), first->second.size()));
    to.ready.erase(first);
    ++to.next;
  }
}

void write_file(const std::filesystem::path& file, const ExrFile& header, Workers& workers,
                const ExrBand& band, Progress* progress) {
  Context to(file);
  write_header(to.exr, header);
  int lines_of_chunk = 0;
  check(exr_get_scanlines_per_chunk(to.exr, kPart, &lines_of_chunk));
  const glm::ivec2 size = header.data_window.size();
  const int chunks = (size.y + lines_of_chunk - 1) / lines_of_chunk;
  begin_phase(progress, "write", chunks);
  workers.for_each(chunks, [&](std::size_t n) {
    const int i = n, y0 = i * lines_of_chunk, y1 = std::min(y0 + lines_of_chunk, size.y);
    std::vector<std::byte> bytes = lines_of(band(y0, y1), size.x, y1 - y0);
    if (header.compression == ExrCompression::zip || header.compression == ExrCompression::zips)
      bytes = pack_zip(bytes, header.reproducible);
    else if (header.compression != ExrCompression::none)
      bytes = packed_by_openexr(to.exr, header.data_window.lo.y + y0, std::move(bytes));
    put_chunk(to, header, lines_of_chunk, i, std::move(bytes));
    advance(progress);
  });
  check(exr_finish(&to.exr));
}

std::vector<ExrChannel> lines_from(const ExrFile& exr, int y0, int y1) {
  const auto width = static_cast<std::ptrdiff_t>(exr.data_window.size().x);
  std::vector<ExrChannel> channels;
  for (const ExrChannel& from : exr.channels) {
    ExrChannel& to = channels.emplace_back();
    to.name = from.name;
    to.type = from.type;
    if (from.type == ExrChannel::Type::uint)
      to.uints.assign(from.uints.begin() + y0 * width, from.uints.begin() + y1 * width);
    else
      to.values.assign(from.values.begin() + y0 * width, from.values.begin() + y1 * width);
  }
  return channels;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const ExrFile& header, Workers& workers,
               const ExrBand& band, Progress* progress) {
  check_writable(file);
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    try {
      write_file(temporary, header, workers, band, progress);
    } catch (const Cancelled&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw EnvironmentError(file.string() + ": cannot be written: " + error.what() + "; is the disk full?");
    }
  });
}

void write_exr(const std::filesystem::path& file, const ExrFile& exr, Progress* progress) {
  Workers workers(1);
  write_exr(
      file, exr, workers, [&](int y0, int y1) { return lines_from(exr, y0, y1); }, progress);
}

}  // namespace pinocchio
