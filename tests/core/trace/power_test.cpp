// Powers in lanes (core/trace/lanes/power.h) against the C library's.
#include <cmath>
#include <cstring>

#include "core/base/aligned_vector.h"
#include "tests/core/trace/lane_probe.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

// Distance in units in the last place of the float nearest to the true value.
double error_ulps(float ours, double exact) {
  const int exponent = std::max(std::ilogb(exact), -126);
  return std::abs(static_cast<double>(ours) - exact) / std::ldexp(1.0, exponent - 23);
}

TEST(Power, WithinHalfAUnitOfLibmAtEveryWidth) {
  constexpr std::size_t kCount = 1 << 16;
  AlignedVector<float> x(kCount), y(kCount), ours(kCount), first(kCount);
  Random random(3);
  for (std::size_t i = 0; i < kCount; ++i) {
    // Every order of magnitude of x, denormals as well, and near 1, where exponents of highlights matter.
    x[i] = i % 2 == 0 ? std::ldexp(random.between(0.5f, 1.0f), -static_cast<int>(i / 2 % 149))
                      : 1.0f - std::ldexp(random.between(0.5f, 1.0f), -static_cast<int>(i / 2 % 24));
    if (!(x[i] > 0.0f)) x[i] = 0x1p-149f;
    y[i] = std::exp2(random.between(-8.0f, 14.0f));
  }
  x[0] = 1.0f, x[1] = 0x1.000002p0f, y[1] = 1e6f, y[2] = 0.0f, x[3] = 0.5f, y[3] = 1.0f;
  double worst = 0.0;
  for (const Isa isa : supported_isas()) {
    lane_probe(isa).power(x.data(), y.data(), ours.data(), kCount);
    if (isa == Isa::scalar) first = ours;
    EXPECT_EQ(std::memcmp(ours.data(), first.data(), kCount * sizeof(float)), 0) << isa_name(isa);
    for (std::size_t i = 0; i < kCount; ++i) {
      const double exact = std::pow(static_cast<double>(x[i]), static_cast<double>(y[i]));
      if (exact < 0x1p-149) {
        EXPECT_LE(ours[i], 0x1p-149f);
      } else {
        worst = std::max(worst, error_ulps(ours[i], exact));
      }
    }
  }
  std::printf("  worst error %.4f units in the last place\n", worst);
  EXPECT_LE(worst, 0.51);
}

}  // namespace
}  // namespace pinocchio
