#include "core/image/codecs/exr_pack.h"

#include <libdeflate.h>

#include <cstddef>
#include <memory>
#include <new>

namespace pinocchio {
namespace {

// Higher levels make EXR files 1 to 3 % smaller and take up to twice the time (docs/measurements.md).
constexpr int kLevel = 1;

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

// A thread's compressor and memory. It keeps them from chunk to chunk, since the system clears new memory
// each time.
struct Packer {
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor{
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor};
  std::vector<std::byte> predicted, packed;
};

}  // namespace

std::vector<std::byte> pack_zip(std::span<const std::byte> lines) {
  if (lines.empty()) return {};
  thread_local Packer packer;
  if (!packer.compressor) throw std::bad_alloc();
  for (std::vector<std::byte>* const memory : {&packer.predicted, &packer.packed})
    if (memory->size() < lines.size()) memory->resize(lines.size());
  predict(lines, packer.predicted.data());
  const std::size_t size = libdeflate_zlib_compress(packer.compressor.get(), packer.predicted.data(),
                                                    lines.size(), packer.packed.data(), lines.size());
  if (size == 0 || size >= lines.size()) return {lines.begin(), lines.end()};
  return {packer.packed.begin(), packer.packed.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace pinocchio
