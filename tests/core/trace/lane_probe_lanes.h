// Part of lane_probe.cpp.in, which names the namespace in PINOCCHIO_LANES.
#include "core/simd/lanes.h"
#include "core/trace/lanes/environment_light.h"
#include "core/trace/lanes/in_triangle.h"
#include "core/trace/lanes/texture.h"
#include "tests/core/trace/lane_probe.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

void samples(const shared::Sampling& sampling, const std::uint32_t* x, const std::uint32_t* y,
             std::uint32_t dimension, float* u, float* v, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth) {
    const vec2 p = sample_2d(sampled_pixel(sampling, whole2(Int::load(x + i), Int::load(y + i))), dimension);
    p.x.store(u + i);
    p.y.store(v + i);
  }
}

void powers(const float* x, const float* y, float* result, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth)
    power(Float::load(x + i), Float::load(y + i)).store(result + i);
}

void parts(const float* y, const float* z, std::uint32_t* number, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth)
    part_of(Vec(Float(0.0f), Float::load(y + i), Float::load(z + i))).store(number + i);
}

void met_in_tile(const TileRays& rays, const std::array<glm::vec3, 3>& corners, MetInTile& met) {
  constexpr std::size_t kLane = kWidth / 2;
  TrianglesInTile triangles;
  for (std::size_t lane = 0; lane < kWidth; ++lane)
    triangles.set_corners(lane, corners[0], corners[1], lane == kLane ? corners[2] : corners[0]);
  triangles.meet(rays);
  met.least_total = triangles.least_total[kLane];
  met.least_for_parts = triangles.least_for_parts[kLane];
  met.footprint = triangles.footprint[kLane];
  met.from_front = (triangles.from_front >> kLane & 1u) != 0;
  for (std::size_t i = 0; i < met.total.size(); ++i) {
    const auto at = [&](const LinearInPixel& number) {
      alignas(64) float value[kWidth];
      number.value(kLane, Float(as_float(i % 32)), Float(as_float(i / 32))).store(value);
      return value[0];
    };
    for (std::size_t k = 0; k < 3; ++k) met.above[k][i] = at(triangles.above[k]);
    met.total[i] = at(triangles.total);
  }
}

void store(const Vec& v, float* const* columns, std::size_t i) {
  v.x.store(columns[0] + i);
  v.y.store(columns[1] + i);
  v.z.store(columns[2] + i);
}

void environment_lights(const EnvironmentLight& environment, const float* const* direction,
                        float* const* light, float* density, std::size_t count) {
  const Mask all = Mask::from_bits(~0u);
  for (std::size_t i = 0; i < count; i += kWidth) {
    const Vec d(Float::load(direction[0] + i), Float::load(direction[1] + i), Float::load(direction[2] + i));
    store(light_from_environment(environment, d, all), light, i);
    density_of_light(environment, d, all).store(density + i);
  }
}

void environment_samples(const EnvironmentLight& environment, const float* u, const float* v,
                         float* const* direction, float* const* light, float* density, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth) {
    const vec2 number[1] = {{Float::load(u + i), Float::load(v + i)}};
    EnvironmentSample sample[1];
    sample_directions(environment, number, Mask::from_bits(~0u), sample);
    store(sample[0].direction, direction, i);
    store(light_of_sample(environment, sample[0].place, sample[0].density, Mask::from_bits(~0u)), light, i);
    sample[0].density.store(density + i);
  }
}

void angles(const float* revolutions, float* cosine, float* sine, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth) {
    const Angle angle = angle_of(Float::load(revolutions + i));
    angle.cosine.store(cosine + i);
    angle.sine.store(sine + i);
  }
}

Int bits_of(Mask m) {
  return select(m, Int(1), Int(0));
}

Int value(LaneOp op, Int x, Int y, const std::uint32_t* table) {
  const Float a = from_bits(x), b = from_bits(y);
  switch (op) {
    case LaneOp::min:
      return bits_of(min(a, b));
    case LaneOp::max:
      return bits_of(max(a, b));
    case LaneOp::less:
      return bits_of(a < b);
    case LaneOp::less_equal:
      return bits_of(a <= b);
    case LaneOp::equal:
      return bits_of(a == b);
    case LaneOp::not_less: {
      const unsigned every_other = 0x5555u & Mask::from_bits(~0u).bits(), met = not_less(a, b, every_other);
      return Int(met == every_other ? 1u : met == 0 ? 0u : 2u);
    }
    case LaneOp::abs:
      return bits_of(abs(a));
    case LaneOp::sqrt:
      return bits_of(sqrt(a));
    case LaneOp::floor:
      return bits_of(floor(a));
    case LaneOp::add:
      return bits_of(a + b);
    case LaneOp::multiply:
      return bits_of(a * b);
    case LaneOp::divide:
      return bits_of(a / b);
    case LaneOp::to_float:
      return bits_of(to_float(x));
    case LaneOp::to_int:
      return to_int(a);
    case LaneOp::whole_less:
      return bits_of(x < y);
    case LaneOp::shift_left:
      return shift_left<7>(x);
    case LaneOp::shift_right:
      return shift_right<7>(x);
    case LaneOp::shift_in_zeros:
      return shift_in_zeros<7>(x);
    case LaneOp::through_double:
      return bits_of(to_float(Double(a) * Double(b)));
    case LaneOp::double_min_max:
      return bits_of(to_float(clamp(Double(a), -1.0, 2.0)));
    case LaneOp::gather:
      return gather(table, x & Int(15), (y & Int(1)) == Int(1));
    case LaneOp::packed:
      break;
  }
  return Int(0);
}

void values(LaneOp op, const std::uint32_t* a, const std::uint32_t* b, std::uint32_t* result,
            std::size_t count) {
  for (std::size_t block = 0; block < count; block += 16) {
    std::size_t to = 0;
    alignas(64) std::uint32_t packed[32]{};  // room for a register behind the last
    for (std::size_t i = block; i < block + 16; i += kWidth) {
      const Int x = Int::load(a + i), y = Int::load(b + i);
      if (op != LaneOp::packed) {
        value(op, x, y, b).store(result + i);
        continue;
      }
      const Mask odd = (y & Int(1)) == Int(1);
      store_packed(packed + to, x, odd);
      to += static_cast<std::size_t>(__builtin_popcount(odd.bits()));
    }
    if (op != LaneOp::packed) continue;
    for (std::size_t i = 0; i < 16; ++i) result[block + i] = i < to ? packed[i] : 0;
  }
}

void channel_of_points(const TexturePlace& place, unsigned lanes, int channel, const TexturePoints& points,
                       float* result) {
  const vec2 uv(Float::load(points.uv[0]), Float::load(points.uv[1]));
  alignas(64) float found[kWidth];
  channel_at(place, uv, channel, Mask::from_bits(lanes)).store(found);
  std::copy_n(found, kWidth, result);
}

}  // namespace

const LaneProbe kProbe{Isa::PINOCCHIO_LANES,
                       kWidth,
                       samples,
                       powers,
                       parts,
                       met_in_tile,
                       sample_textures,
                       channel_of_points,
                       environment_lights,
                       environment_samples,
                       values,
                       angles};

}  // namespace pinocchio::PINOCCHIO_LANES
