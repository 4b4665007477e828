#include "core/image/codecs/exr_pack.h"

#include <isa-l/igzip_lib.h>
#include <libdeflate.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Sixteen [[gnu::vector_size(16), gnu::may_alias, gnu::aligned(1)]] = unsigned char;

Sixteen& sixteen_at(unsigned char* p) {
  return *reinterpret_cast<Sixteen*>(p);
}
const Sixteen& sixteen_at(const unsigned char* p) {
  return *reinterpret_cast<const Sixteen*>(p);
}

// Separates bytes at even and odd places, and stores each as the difference to the previous one (as
// ImfZip.cpp): high bytes differ little from pixel to pixel.
void predict(std::span<const std::byte> lines, std::byte* to) {
  const auto* const in = reinterpret_cast<const unsigned char*>(lines.data());
  const std::size_t n = lines.size();
  auto* const even = reinterpret_cast<unsigned char*>(to);
  auto* const odd = even + (n + 1) / 2;
  even[0] = in[0];
  if (n < 2) return;
  odd[0] = static_cast<unsigned char>(in[1] - in[(n - 1) / 2 * 2] + 128);
  std::size_t i = 2;
  for (; i + 32 <= n; i += 32) {
    const Sixteen a = sixteen_at(in + i) - sixteen_at(in + i - 2) + 128,
                  b = sixteen_at(in + i + 16) - sixteen_at(in + i + 14) + 128;
    sixteen_at(even + i / 2) =
        __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    sixteen_at(odd + i / 2) =
        __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
  }
  for (; i < n; ++i) (i % 2 == 0 ? even : odd)[i / 2] = static_cast<unsigned char>(in[i] - in[i - 2] + 128);
}

// libdeflate: its bytes depend on nothing but its version. The level is chosen by
// docs/measurements/packers.csv.
class ReproduciblePacker {
 public:
  // The size, or 0 if `to` is too small.
  std::size_t pack(std::span<const std::byte> from, std::span<std::byte> to) {
    if (!compressor_) throw std::bad_alloc();
    return libdeflate_zlib_compress(compressor_.get(), from.data(), from.size(), to.data(), to.size());
  }

 private:
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor_{
      libdeflate_alloc_compressor(1), libdeflate_free_compressor};
};

// ISA-L. The level is chosen by the same table.
class FastPacker {
 public:
  std::size_t pack(std::span<const std::byte> from, std::span<std::byte> to) {
    isal_deflate_stateless_init(stream_.get());
    stream_->level = 2;
    stream_->level_buf = memory_.data();
    stream_->level_buf_size = as_uint32(memory_.size());
    stream_->gzip_flag = IGZIP_ZLIB;
    stream_->end_of_stream = 1;
    stream_->next_in = reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(from.data()));
    stream_->avail_in = as_uint32(from.size());
    stream_->next_out = reinterpret_cast<std::uint8_t*>(to.data());
    stream_->avail_out = as_uint32(to.size());
    return isal_deflate_stateless(stream_.get()) == COMP_OK ? stream_->total_out : 0;
  }

 private:
  std::unique_ptr<isal_zstream> stream_ = std::make_unique<isal_zstream>();
  std::vector<std::uint8_t> memory_ = std::vector<std::uint8_t>(ISAL_DEF_LVL2_DEFAULT);
};

// ISA-L 2.30's checksum reads beyond the last byte on arm64. Bytes.
constexpr std::size_t kReadBeyond = 64;

// A thread's memory. It is kept from chunk to chunk, since the system clears new memory each time.
struct PackerMemory {
  std::vector<std::byte> predicted, packed;
};

template <class Packer>
std::size_t pack_by(std::span<const std::byte> from, std::span<std::byte> to) {
  thread_local Packer packer;
  return packer.pack(from, to);
}

}  // namespace

std::vector<std::byte> pack_zip(std::span<const std::byte> lines, bool reproducible) {
  if (lines.empty()) return {};
  thread_local PackerMemory memory;
  for (std::vector<std::byte>* const bytes : {&memory.predicted, &memory.packed})
    if (bytes->size() < lines.size() + kReadBeyond) bytes->resize(lines.size() + kReadBeyond);
  predict(lines, memory.predicted.data());
  const std::span from(memory.predicted.data(), lines.size()), to(memory.packed.data(), lines.size());
  const std::size_t size =
      reproducible ? pack_by<ReproduciblePacker>(from, to) : pack_by<FastPacker>(from, to);
  if (size == 0 || size >= lines.size()) return {lines.begin(), lines.end()};
  return {to.begin(), to.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace pinocchio
