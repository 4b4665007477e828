#include "hybrid/inspect/exchange_cost.h"

#include <cstring>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/math/median.h"
#include "gl/objects/fence.h"
#include "gl/transfer/transfer.h"
#include "hybrid/engine/engine_parts.h"
#include "hybrid/exchange/channels.h"

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

ExchangeCost measure_exchange(Engine& engine, const Settings& settings, glm::ivec2 size) {
  const gl::Mapping mapping = settings.persistent ? gl::Mapping::persistent : gl::Mapping::each_time;
  ExchangeCost cost;
  engine.open_gl();
  engine.parts().enter([&] {
    for (const ChannelLayout& c : channels_of(settings, size)) {
      if (goes_to_cpu(c.channel)) {
        add_readback(c.texels, c.texel, mapping, cost);
      } else {
        add_upload(c.texels, c.texel, mapping, cost);
      }
    }
  });
  return cost;
}

}  // namespace pinocchio
