#include "core/trace/view/view_params.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/jitter.h"
#include "scenes/generator/paint.h"

namespace pinocchio {
namespace {

const Camera kCamera{"c", {1, 2, 3}, {1, 2, -7}, {0, 1, 0}, 90.0f};

TEST(View, PixelRaysSpanTheFieldOfView) {
  const shared::ViewParams view = view_params(kCamera, {200, 100});
  const glm::vec3 top_left = pixel_ray(view, 0, 0).direction,
                  bottom_right = pixel_ray(view, 199, 99).direction;
  // tan(45 degrees) = 1 at the edge of the picture, half a pixel outside the outermost centres.
  EXPECT_NEAR(top_left.y, 0.99f, 1e-5f);
  EXPECT_NEAR(top_left.x, -1.99f, 1e-5f);
  EXPECT_NEAR(bottom_right.y, -0.99f, 1e-5f);
  EXPECT_NEAR(bottom_right.x, 1.99f, 1e-5f);
  EXPECT_EQ(top_left.z, -1.0f);  // t is z_eye
}

TEST(View, PartsHaveTheWholePicturesRays) {
  const shared::ViewParams whole = view_params(kCamera, {640, 480});
  const shared::ViewParams part = view_params(kCamera, {640, 480}, glm::vec2(0.0f), {100, 37});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x)
      EXPECT_EQ(pixel_ray(part, x, y).direction, pixel_ray(whole, 100 + x, 37 + y).direction);
}

// fx, fy, cx, cy of a picture that is off its axis, and what they say of a point before the camera.
TEST(View, MeasuredCamerasSeeWhereOpenCvSays) {
  const glm::ivec2 size(320, 200);
  const Intrinsics k{310.0, 290.0, 140.5, 120.25};
  const Camera camera =
      with_intrinsics({"c", {1, 2, 3}, {1, 2, 13}, {0, -1, 0}}, k, size);  // x right, y down, z forward
  const shared::ViewParams view = view_params(camera, size);
  for (const glm::ivec2 pixel :
       {glm::ivec2(0, 0), glm::ivec2(319, 0), glm::ivec2(17, 199), glm::ivec2(160, 100)}) {
    const glm::vec3 along = pixel_ray(view, pixel.x, pixel.y).direction;
    EXPECT_NEAR(along.x, (pixel.x - k.cx) / k.fx, 1e-6);
    EXPECT_NEAR(along.y, (pixel.y - k.cy) / k.fy, 1e-6);
    EXPECT_NEAR(along.z, 1.0f, 1e-6);
  }
  const Intrinsics again = intrinsics_of(camera, size);
  for (const auto& [a, b] : {std::pair(again.fx, k.fx), {again.fy, k.fy}, {again.cx, k.cx}, {again.cy, k.cy}})
    EXPECT_NEAR(a, b, 1e-4);
}

TEST(View, LooksAlongUpWithoutTrouble) {
  const CameraAxes axes = camera_axes({"c", {0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 45.0f});
  EXPECT_NEAR(glm::length(axes.right), 1.0f, 1e-6f);
  EXPECT_NEAR(glm::dot(axes.right, axes.forward), 0.0f, 1e-6f);
  EXPECT_EQ(axes.forward, glm::vec3(0, -1, 0));
}

constexpr int kFilterSamples = 4096;

// Blackman and Harris 1978, four terms, 3 pixels wide; of area 1.
double window(double x) {
  if (std::abs(x) >= 1.5) return 0.0;
  const double t = 2.0 * std::numbers::pi * (x / 3.0 + 0.5);
  const double four =
      0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2.0 * t) - 0.01168 * std::cos(3.0 * t);
  return four / (0.35875 * 3.0);
}

double area(double from, double to) {
  constexpr int kSteps = 1000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += window(from + (to - from) * (i + 0.5) / kSteps);
  return sum * (to - from) / kSteps;
}

TEST(PixelFilter, TheBoxIsEvenAndTheWindowIsBlackmansAndHarris) {
  for (const PixelFilter filter : {PixelFilter::box, PixelFilter::blackman_harris}) {
    EXPECT_EQ(jitter_of(0, filter), glm::vec2(0.0f));  // one sample a pixel: its centre
    std::array<std::array<int, 30>, 2> bins{};
    for (int k = 0; k < kFilterSamples; ++k)
      for (int axis = 0; axis < 2; ++axis) {
        const float at = jitter_of(k, filter)[axis];
        ASSERT_LE(std::abs(at), filter == PixelFilter::box ? 0.5f : 1.5f);
        ++bins[static_cast<std::size_t>(axis)]
              [static_cast<std::size_t>(std::min((at + 1.5f) * 10.0f, 29.0f))];
      }
    for (const auto& axis : bins)
      for (int i = 0; i < 30; ++i) {
        const double from = 0.1 * i - 1.5, to = from + 0.1;
        const double share = filter == PixelFilter::box ? (i >= 10 && i < 20 ? 0.1 : 0.0) : area(from, to);
        EXPECT_NEAR(static_cast<double>(axis[static_cast<std::size_t>(i)]) / kFilterSamples, share, 0.002)
            << from;
      }
  }
}

// So outlines stay where they are, however few the samples.
TEST(PixelFilter, TheCentreIsTheMean) {
  for (const PixelFilter filter : {PixelFilter::box, PixelFilter::blackman_harris}) {
    glm::dvec2 sum(0.0);
    for (int k = 0; k < 4096; ++k) {
      sum += glm::dvec2(jitter_of(k, filter));
      const int samples = k + 1;
      if (samples == 4 || (samples >= 8 && samples % 2 == 0)) {
        EXPECT_LT(glm::length(sum), 1e-5 * samples) << samples << " samples";
      }
    }
  }
}

TEST(LensPoints, AreEvenOnTheDiscAndTheMiddleIsTheirMean) {
  EXPECT_EQ(lens_point_of(0), glm::vec2(0.0f));
  constexpr int kSamples = 4096;
  glm::dvec2 sum(0.0);
  int in_half = 0, in_quarter = 0;
  for (int k = 0; k < kSamples; ++k) {
    const glm::vec2 at = lens_point_of(k);
    ASSERT_LE(glm::length(at), 1.0f) << k;
    sum += glm::dvec2(at);
    if (k >= 3 && k % 2 == 1) {
      EXPECT_LT(glm::length(sum), 1e-5 * (k + 1)) << k + 1 << " samples";
    }
    in_half += glm::dot(at, at) < 0.5f ? 1 : 0;
    in_quarter += at.x > 0.0f && at.y > 0.0f ? 1 : 0;
  }
  // Quarters of the disc differ by 3 % at any number of samples.
  EXPECT_NEAR(in_half, kSamples / 2, kSamples / 100);
  EXPECT_NEAR(in_quarter, kSamples / 4, kSamples / 100);
}

// Outlines: the error of the share of a pixel that an edge covers, beside that of as many random points.
TEST(PixelFilter, FewSamplesFindOutlines) {
  const auto error = [](int samples) {
    constexpr int kAngles = 48, kOffsets = 32, kSide = 48;
    double squares = 0.0, random = 0.0;
    for (int a = 0; a < kAngles; ++a)
      for (int o = 0; o < kOffsets; ++o) {
        const double angle = 2.0 * 3.14159265358979 * a / kAngles, offset = (o + 0.5) / kOffsets * 1.4 - 0.7;
        const auto covers = [&](double x, double y) {
          return x * std::cos(angle) + y * std::sin(angle) < offset ? 1.0 : 0.0;
        };
        double area = 0.0, found = 0.0;
        for (int i = 0; i < kSide * kSide; ++i)
          area += covers((i % kSide + 0.5) / kSide - 0.5, (i / kSide + 0.5) / kSide - 0.5);
        area /= kSide * kSide;
        for (int k = 0; k < samples; ++k) {
          const glm::dvec2 at(jitter_of(k));
          found += covers(at.x, at.y);
        }
        squares += std::pow(area - found / samples, 2);
        random += area * (1.0 - area) / samples;
      }
    return std::sqrt(squares / random);
  };
  for (const int samples : {4, 8, 10, 12, 14, 16, 24, 32, 64})
    EXPECT_LT(error(samples), samples < 16 ? 0.6 : 0.45) << samples;
}

// An edge between two pixels: sharp by the box, the window's area on either side of it by the other.
TEST(PixelFilter, AnEdgeHasItsProfile) {
  constexpr int kWidth = 8, kSamples = 512;
  MeshData mesh;
  mesh.positions = {{-100, -100, -1}, {0, -100, -1}, {0, 100, -1}, {-100, 100, -1}};
  mesh.normals.assign(4, glm::vec3(0.0f));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.triangle_materials = {0, 0};
  mesh.materials = {glowing("", glm::vec3(1.0f))};
  const Scene scene(std::move(mesh));
  const Tracer tracer(scene.mesh, {});
  Workers one(1);
  for (const PixelFilter filter : {PixelFilter::box, PixelFilter::blackman_harris}) {
    std::array<double, kWidth> row{};
    for (int k = 0; k < kSamples; ++k) {
      const View view = at_sample({{"", glm::vec3(0.0f), {0, 0, -1}}, {kWidth, kWidth}}, k, filter);
      Image<glm::vec4> color;
      TileOutputs out;
      out.size = {kWidth, kWidth};
      out.color = &color;
      trace_tiles({scene, tracer, one, view_params(view)}, out);
      for (int x = 0; x < kWidth; ++x)
        row[static_cast<std::size_t>(x)] += static_cast<double>(color.at(x, 3).r) / kSamples;
    }
    for (int x = 0; x < kWidth; ++x) {
      const double from_edge = kWidth / 2 - (x + 0.5);  // to the right of the pixel's centre
      const double expected = filter == PixelFilter::box ? (from_edge > 0.0 ? 1.0 : 0.0)
                                                         : area(-1.5, std::clamp(from_edge, -1.5, 1.5));
      EXPECT_NEAR(row[static_cast<std::size_t>(x)], expected, 0.004) << x;
    }
  }
}

}  // namespace
}  // namespace pinocchio
