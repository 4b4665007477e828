// Operations of the lanes on the numbers where processors differ, against values that are written down here:
// the same on every instruction set and architecture. NaN is NaN, whatever its sign.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "tests/core/trace/lane_probe.h"

namespace pinocchio {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kTiny = std::numeric_limits<float>::denorm_min();
constexpr std::uint32_t kLowest = 0x80000000u;  // also the integer for a float that has none

std::uint32_t bits(float x) {
  return __builtin_bit_cast(std::uint32_t, x);
}
float number(std::uint32_t x) {
  return __builtin_bit_cast(float, x);
}

struct Row {
  LaneOp op;
  std::uint32_t a, b, result;
};
Row row(LaneOp op, float a, float b, float result) {
  return {op, bits(a), bits(b), bits(result)};
}
Row holds(LaneOp op, float a, float b, bool result) {
  return {op, bits(a), bits(b), result ? 1u : 0u};
}

const Row kRows[]{
    // Where either is NaN, and where both are zeros, the second.
    row(LaneOp::min, 1, 2, 1),
    row(LaneOp::min, kNan, 2, 2),
    row(LaneOp::min, 1, kNan, kNan),
    row(LaneOp::min, 0.0f, -0.0f, -0.0f),
    row(LaneOp::min, -0.0f, 0.0f, 0.0f),
    row(LaneOp::min, kInfinity, -kInfinity, -kInfinity),
    row(LaneOp::max, 1, 2, 2),
    row(LaneOp::max, kNan, 2, 2),
    row(LaneOp::max, 1, kNan, kNan),
    row(LaneOp::max, 0.0f, -0.0f, -0.0f),
    row(LaneOp::max, -0.0f, 0.0f, 0.0f),
    row(LaneOp::max, kTiny, 0.0f, kTiny),

    holds(LaneOp::less, 1, 2, true),
    holds(LaneOp::less, -0.0f, 0.0f, false),
    holds(LaneOp::less, 0.0f, kTiny, true),
    holds(LaneOp::less, kNan, 1, false),
    holds(LaneOp::less, 1, kNan, false),
    holds(LaneOp::less_equal, -0.0f, 0.0f, true),
    holds(LaneOp::less_equal, kNan, kNan, false),
    holds(LaneOp::equal, 0.0f, -0.0f, true),
    holds(LaneOp::equal, kNan, kNan, false),
    holds(LaneOp::equal, kTiny, 0.0f, false),
    holds(LaneOp::not_less, 1, 2, false),
    holds(LaneOp::not_less, 2, 1, true),
    holds(LaneOp::not_less, -0.0f, 0.0f, true),
    holds(LaneOp::not_less, kNan, 1, true),
    holds(LaneOp::not_less, 1, kNan, true),

    row(LaneOp::abs, -0.0f, 0, 0.0f),
    row(LaneOp::abs, -kInfinity, 0, kInfinity),
    row(LaneOp::abs, kNan, 0, kNan),
    row(LaneOp::sqrt, 2, 0, 0x1.6a09e6p0f),
    row(LaneOp::sqrt, -0.0f, 0, -0.0f),
    row(LaneOp::sqrt, -1, 0, kNan),
    row(LaneOp::sqrt, kTiny, 0, 0x1.6a09e6p-75f),
    row(LaneOp::floor, -0.5f, 0, -1),
    row(LaneOp::floor, -0.0f, 0, -0.0f),
    row(LaneOp::floor, 0.99999994f, 0, 0.0f),
    row(LaneOp::floor, -kTiny, 0, -1),
    row(LaneOp::floor, 3e9f, 0, 3e9f),
    row(LaneOp::floor, -kInfinity, 0, -kInfinity),
    row(LaneOp::floor, kNan, 0, kNan),

    // Halves to even; numbers below the normal ones are kept.
    row(LaneOp::add, 16777216, 1, 16777216),
    row(LaneOp::add, 16777218, 1, 16777220),
    row(LaneOp::add, kInfinity, -kInfinity, kNan),
    row(LaneOp::multiply, 0x1p-126f, 0.5f, 0x1p-127f),
    row(LaneOp::multiply, kTiny, 0.5f, 0.0f),
    row(LaneOp::multiply, 3 * kTiny, 0.5f, 2 * kTiny),
    row(LaneOp::multiply, 0, kInfinity, kNan),
    row(LaneOp::divide, 1, 3, 0x1.555556p-2f),
    row(LaneOp::divide, 1, -0.0f, -kInfinity),
    row(LaneOp::divide, 0x1p-126f, 3, 0x2aaaabp-149f),
    row(LaneOp::divide, 0, 0, kNan),

    {LaneOp::to_float, 16777217, 0, bits(16777216.0f)},
    {LaneOp::to_float, 0x7fffffff, 0, bits(2147483648.0f)},
    {LaneOp::to_float, kLowest, 0, bits(-2147483648.0f)},
    {LaneOp::to_int, bits(-1.9f), 0, 0xffffffffu},
    {LaneOp::to_int, bits(2147483520.0f), 0, 0x7fffff80u},
    {LaneOp::to_int, bits(2147483648.0f), 0, kLowest},
    {LaneOp::to_int, bits(-2147483648.0f), 0, kLowest},
    {LaneOp::to_int, bits(-2147483904.0f), 0, kLowest},
    {LaneOp::to_int, bits(kInfinity), 0, kLowest},
    {LaneOp::to_int, bits(-kInfinity), 0, kLowest},
    {LaneOp::to_int, bits(kNan), 0, kLowest},

    {LaneOp::whole_less, 0xffffffffu, 0, 1},  // -1 < 0
    {LaneOp::whole_less, 0, kLowest, 0},
    {LaneOp::shift_left, 0x83000001u, 0, 0x80000080u},
    {LaneOp::shift_right, 0x80000080u, 0, 0xff000001u},
    {LaneOp::shift_in_zeros, 0x80000080u, 0, 0x01000001u},

    // By double and back: one rounding.
    row(LaneOp::through_double, 0x1p-100f, 0x1p-49f, kTiny),
    row(LaneOp::through_double, 0x1p-100f, 0x1p-50f, 0.0f),
    row(LaneOp::through_double, 3e38f, 10, kInfinity),
    row(LaneOp::through_double, kNan, 1, kNan),
    row(LaneOp::double_min_max, kNan, 0, -1),  // max(x, -1), then min(x, 2): the second each time
    row(LaneOp::double_min_max, kInfinity, 0, 2),
    row(LaneOp::double_min_max, -kInfinity, 0, -1),
    row(LaneOp::double_min_max, 0.5f, 0, 0.5f),
};

class LaneValues : public testing::TestWithParam<Isa> {
 protected:
  // A row in each lane in turn, so that no lane is special.
  static std::array<std::uint32_t, 16> run(Isa isa, const Row& row) {
    alignas(64) std::array<std::uint32_t, 16> a, b, result{};
    a.fill(row.a);
    b.fill(row.b);
    lane_probe(isa).values(row.op, a.data(), b.data(), result.data(), a.size());
    return result;
  }
};

bool same(LaneOp op, std::uint32_t a, std::uint32_t b) {
  const bool whole = op >= LaneOp::to_int && op <= LaneOp::shift_in_zeros;
  return a == b || (!whole && std::isnan(number(a)) && std::isnan(number(b)));
}

TEST_P(LaneValues, AreTheSameOnEveryProcessor) {
  for (const Row& row : kRows)
    for (const std::uint32_t result : run(GetParam(), row))
      ASSERT_TRUE(same(row.op, result, row.result))
          << "row " << &row - kRows << ": " << std::hex << row.a << ", " << row.b << " gives " << result
          << ", not " << row.result;
}

TEST_P(LaneValues, GatherAndPackByMask) {
  alignas(64) std::array<std::uint32_t, 16> a, b, result{};
  for (std::uint32_t mask = 0; mask < 0x10000; mask += mask < 256 ? 1 : 251) {
    for (std::uint32_t i = 0; i < 16; ++i) {
      a[i] = (i * 7 + 3) % 16;
      b[i] = i * 2 + (mask >> i & 1);
    }
    lane_probe(GetParam()).values(LaneOp::gather, a.data(), b.data(), result.data(), 16);
    for (std::uint32_t i = 0; i < 16; ++i)
      ASSERT_EQ(result[i], mask >> i & 1 ? b[a[i]] : 0) << mask << " " << i;
    lane_probe(GetParam()).values(LaneOp::packed, a.data(), b.data(), result.data(), 16);
    std::size_t to = 0;
    for (std::uint32_t i = 0; i < 16; ++i) {
      if ((mask >> i & 1) == 0) continue;
      ASSERT_EQ(result[to++], a[i]) << mask << " " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EachIsa, LaneValues, testing::ValuesIn(supported_isas()),
                         [](const auto& p) { return std::string(isa_name(p.param)); });

}  // namespace
}  // namespace pinocchio
