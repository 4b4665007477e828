#include "hybrid/exchange_cost.h"

#include <cstring>
#include <utility>
#include <vector>

#include "core/math/median.h"
#include "core/trace/mask_image.h"
#include "hybrid/formats.h"
#include "hybrid/record.h"

namespace pinocchio {
namespace {

constexpr int kTries = 31;

template <class Act>
double median_ms(Act act) {
  std::vector<double> times_ms;
  for (int i = 0; i < kTries; ++i) {
    const double begin_s = now_s();
    act();
    times_ms.push_back(1e3 * (now_s() - begin_s));
  }
  return median(std::move(times_ms));
}

double copy_ms(std::size_t bytes) {
  const std::vector<std::byte> from(bytes, std::byte{1});
  std::vector<std::byte> to(bytes);
  return median_ms([&] { std::memcpy(to.data(), from.data(), bytes); });
}

void add_readback(glm::ivec2 size, const gl::PixelFormat& format, gl::Mapping mapping, ExchangeCost& cost) {
  const gl::Framebuffer source(size, format, false);
  gl::Readback back(mapping);
  gl::Fence::insert().wait();
  cost.to_cpu_ms += median_ms([&] {
    back.start(source);
    (void)back.open();
    back.close();
  });
  cost.memcpy_to_cpu_ms += copy_ms(source.color().bytes());
}

void add_upload(glm::ivec2 size, const gl::PixelFormat& format, gl::Mapping mapping, ExchangeCost& cost) {
  const gl::Texture target(size, format);
  gl::Upload up(mapping);
  cost.to_gpu_ms += median_ms([&] {
    (void)up.open(target.bytes());
    up.send(target);
    gl::Fence::insert().wait();
  });
  cost.memcpy_to_gpu_ms += copy_ms(target.bytes());
}

}  // namespace

ExchangeCost measure_exchange(const Plan& plan, glm::ivec2 size, gl::Mapping mapping) {
  ExchangeCost cost;
  if (plan.mode != Mode::hybrid || !plan.traces()) return cost;
  if (plan.primary == Primary::rays) {
    add_upload(size, id_format(plan.id_bits).pixel, mapping, cost);
  } else {
    add_readback(size, plan.wide ? gl::kRgba32Ui : id_format(plan.id_bits).pixel, mapping, cost);
  }
  if (plan.design == 2) {
    add_readback(size, gl::kSrgb8, mapping, cost);
    add_upload(component_size(size), gl::kR8, mapping, cost);
    return cost;
  }
  if (plan.normals) add_readback(size, gl::kRgb8, mapping, cost);
  const glm::ivec2 mask = scaled_size(size, plan.mask_scale),
                   reflection = scaled_size(size, plan.reflection_scale);
  if (plan.mask_bits > 0)
    add_upload({MaskImage::row_bytes_for(mask.x, plan.mask_bits), mask.y}, gl::kR8Ui, mapping, cost);
  const auto [pixel, texels] = texel_format(plan.reflection);
  if (plan.reflects()) add_upload({texels * reflection.x, reflection.y}, pixel, mapping, cost);
  return cost;
}

}  // namespace pinocchio
