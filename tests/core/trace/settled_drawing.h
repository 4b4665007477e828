// Pictures of hybrid's part with settled triangles, against those without.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "core/trace/settled/settled_triangles.h"
#include "core/trace/tiles/tile_plan.h"
#include "core/trace/view/view_params.h"
#include "tests/support/drawn_tiles.h"
#include "tests/support/same_bits.h"
#include "tests/support/scenes.h"

namespace pinocchio {

inline constexpr glm::ivec2 kSettledSize{150, 90};  // tiles that are cut off on both sides

// Hybrid's part, from given ids.
inline DrawnTiles draw(const TraceJob& job, const Image<std::uint32_t>& seen) {
  return draw_tiles(job, kSettledSize, 3, &seen, false);
}

inline void expect_same(const DrawnTiles& a, const DrawnTiles& b) {
  EXPECT_TRUE(same_bits(a.reflection, b.reflection));
  EXPECT_TRUE(std::ranges::equal(a.mask.bytes(), b.mask.bytes()));
  EXPECT_EQ(a.rays.shadow, b.rays.shadow);
  EXPECT_EQ(a.rays.reflection, b.rays.reflection);
}

struct Share {
  std::size_t settled = 0, all = 0;

  Share& operator+=(const Share& o) {
    settled += o.settled;
    all += o.all;
    return *this;
  }
};

// How many of the visible triangles are settled, as a whole or in a part.
inline Share settled_share(const Tracer& tracer, const SettledTriangles& settled,
                           const Image<std::uint32_t>& seen) {
  Share share;
  std::vector<std::uint8_t> done(tracer.mesh().triangles.size());
  for (const std::uint32_t id : seen.pixels()) {
    if (id == kNoTriangle || std::exchange(done[id], 1)) continue;
    const SettledPoints of = settled.of(id);
    bool any = of.state == SettledPoints::State::settled;
    for (std::uint32_t part = 0; part < kParts && of.state == SettledPoints::State::by_part; ++part)
      any = any || settled.of_part(of, part).state == SettledPoints::State::settled;
    share.settled += any ? 1 : 0;
    ++share.all;
  }
  return share;
}

// The settled triangles that the tile pass uses once two pictures in a row had the same lights.
inline std::shared_ptr<SettledTriangles> asked_by(const TraceJob& job) {
  TileOutputs out;
  out.size = kSettledSize;
  out.mask_bits = mask_bits_of(job.scene);
  out.depth = 3;
  (void)TilePlan(job, out);
  return TilePlan(job, out).settled;
}

// Draws hybrid's part of some pictures often enough that much is known, in turns, and compares it with what
// is drawn when nothing is known.
inline Share expect_same_when_known(TraceJob job, const std::vector<Camera>& cameras, int frames) {
  std::vector<Image<std::uint32_t>> ids;
  std::vector<DrawnTiles> expected;
  job.options.light_cutoff = light_cutoff_of(static_cast<int>(job.scene.lights.size()));
  for (const Camera& camera : cameras) {
    job.view = view_params(camera, kSettledSize);
    trace_visibility(job, ids.emplace_back(kSettledSize));
    job.options.clear_ways = false;
    expected.push_back(draw(job, ids.back()));
  }
  job.options.clear_ways = true;
  for (int round = 0; round < 2; ++round)
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      job.view = view_params(cameras[i], kSettledSize);
      for (int frame = 0; frame < frames; ++frame) expect_same(draw(job, ids[i]), expected[i]);
    }
  Share share;
  if (!job.tracer.settled() || job.options.terminator == Terminator::displaced) return share;
  const std::shared_ptr<SettledTriangles> settled = asked_by(job);
  for (const Image<std::uint32_t>& seen : ids) share += settled_share(job.tracer, *settled, seen);
  return share;
}

}  // namespace pinocchio
