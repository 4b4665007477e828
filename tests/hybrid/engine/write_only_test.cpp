// What is written into buffers that are mapped for writing: nothing is read from them, and the result does
// not depend on what was there.
#include <gtest/gtest.h>

#include <vector>

#include "hybrid/exchange/encode.h"
#include "hybrid/exchange/reflection_tiles.h"
#include "tests/support/write_only_memory.h"

namespace pinocchio {
namespace {

#ifdef PINOCCHIO_WRITE_ONLY_MEMORY
constexpr ReflectionFormat kFormats[] = {ReflectionFormat::rgb8, ReflectionFormat::rgb9e5,
                                         ReflectionFormat::half, ReflectionFormat::full};

// `write` fills the first bytes of the memory that it is given and returns how many.
template <class Write>
void expect_only_written(std::size_t bytes, Write write) {
  std::vector<std::vector<std::byte>> results;
  for (const std::byte pattern : {std::byte{0}, std::byte{0xff}, std::byte{0x5a}}) {
    WriteOnlyMemory memory(bytes, pattern);
    const std::size_t written = write(memory.bytes());
    memory.watch_no_longer();
    EXPECT_EQ(memory.reads(), 0);
    results.emplace_back(memory.bytes().begin(),
                         memory.bytes().begin() + static_cast<std::ptrdiff_t>(written));
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

Image<glm::vec3> half_lit(glm::ivec2 size) {
  Image<glm::vec3> light(size);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; x += 1 + y / 8 * 8)
      light.at(x, y) = {0.1f * static_cast<float>(x), 0.5f, 2.0f};
  return light;
}

TEST(WriteOnly, TheMemoryCountsReads) {
  WriteOnlyMemory memory(8, std::byte{1});
  volatile std::byte* const bytes = memory.bytes().data();
  bytes[0] = std::byte{2};
  EXPECT_EQ(memory.reads(), 0);
  const std::byte read = bytes[0];
  EXPECT_EQ(read, std::byte{2});
  EXPECT_EQ(memory.reads(), 1);
}

TEST(WriteOnly, Tiles) {
  Workers workers(1);
  const Image<glm::vec3> light = half_lit({32, 24});
  for (const ReflectionFormat format : kFormats) {
    std::vector<std::uint32_t> index;
    expect_only_written(most_tile_bytes(light.size(), format), [&](std::span<std::byte> to) {
      const std::size_t tiles = pack_tiles(light, {}, format, workers, index, to);
      EXPECT_GT(tiles, 0u);
      return std::as_bytes(std::span(index)).size() + tiles * bytes_per_tile(format);
    });
  }
}

TEST(WriteOnly, PlainLightAndIds) {
  Workers workers(1);
  const Image<glm::vec3> light = half_lit({19, 5});
  for (const ReflectionFormat format : kFormats) {
    const std::size_t bytes = light.pixels().size() * static_cast<std::size_t>(bytes_per_pixel(format));
    expect_only_written(bytes, [&](std::span<std::byte> to) {
      pack_radiance(light, format, workers, to);
      return to.size();
    });
  }
  const Image<std::uint32_t> ids(light.size(), 77u);
  for (const int id_bits : {16, 24, 32})
    expect_only_written(ids.pixels().size() * static_cast<std::size_t>(id_bits / 8),
                        [&](std::span<std::byte> to) {
                          pack_ids(ids, id_bits, to);
                          return to.size();
                        });
}
#endif

}  // namespace
}  // namespace pinocchio
