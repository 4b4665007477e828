#include "core/geometry/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>

#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

using Ring = std::vector<glm::vec3>;

double area_of(const Ring& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec3 a(ring[i]), b(ring[(i + 1) % ring.size()]);
    sum += a.x * b.y - a.y * b.x;
  }
  return 0.5 * sum;
}

// Triangles that turn as the polygon does and together have its area.
void expect_covered(const Ring& ring) {
  const PolygonTriangles polygon = triangulate(ring);
  EXPECT_TRUE(polygon.simple);
  ASSERT_EQ(polygon.triangles.size(), ring.size() - 2);
  const double whole = area_of(ring);
  double sum = 0.0;
  for (const glm::uvec3& t : polygon.triangles) {
    const double area = area_of({ring[t.x], ring[t.y], ring[t.z]});
    EXPECT_GE(area * whole, 0.0);
    sum += area;
  }
  EXPECT_NEAR(sum, whole, 1e-5 * std::abs(whole));
}

glm::vec3 on_circle(double radius, double turns) {
  const double angle = 2.0 * std::numbers::pi * turns;
  return {radius * std::cos(angle), radius * std::sin(angle), 0.0};
}

// A comb or a star with teeth of uneven depth.
Ring star(std::size_t corners) {
  Random random(7);
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i)
    ring.push_back(on_circle(i % 2 == 0 ? 10.0 : 2.0 + 7.0 * (random.next() % 1000) / 1000.0,
                             static_cast<double>(i) / static_cast<double>(corners)));
  return ring;
}

Ring comb(int teeth) {
  Ring ring{{0, 0, 0}, {static_cast<float>(2 * teeth), 0, 0}};
  for (int i = teeth - 1; i >= 0; --i) {
    ring.emplace_back(2 * i + 1.5f, 9.0f, 0.0f);
    ring.emplace_back(2 * i + 1.0f, 1.0f, 0.0f);
  }
  return ring;
}

TEST(Polygon, QuadsAreCutFromTheirFirstCornerAsOtherProgramsDo) {
  const Ring bent{{0, 0, 0}, {4, -1, 1}, {5, 0, 0}, {4, 1, 1}};  // the other diagonal is shorter
  EXPECT_EQ(triangulate(bent).triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
  const Ring arrow{{0, 0, 0}, {4, -3, 0}, {1, 0, 0}, {4, 3, 0}};  // points inwards at corner 2
  EXPECT_EQ(triangulate(arrow).triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
  expect_covered(arrow);
  const Ring turned{{4, 3, 0}, {0, 0, 0}, {4, -3, 0}, {1, 0, 0}};  // at corner 3
  EXPECT_EQ(triangulate(turned).triangles, (std::vector<glm::uvec3>{{0, 1, 3}, {1, 2, 3}}));
  expect_covered(turned);
}

TEST(Polygon, AFanWhereItCoversThem) {
  const std::vector<glm::uvec3> fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_EQ(triangulate(Ring{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {4, 4, 0}, {0, 4, 0}}).triangles, fan);
  const Ring dented{{0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {4, 4, 0}, {0, 4, 0}};
  EXPECT_EQ(triangulate(dented).triangles, fan);
  expect_covered(dented);
}

TEST(Polygon, ConcaveOnes) {
  expect_covered({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
  expect_covered({{0, 0, 0}, {0, 4, 0}, {2, 1, 0}, {4, 4, 0}, {4, 0, 0}});  // the other way round
  expect_covered(star(101));
  expect_covered(comb(40));
  Ring stairs{{0, 0, 0}};  // corners at one height
  for (int i = 0; i < 20; ++i) {
    stairs.emplace_back(i + 1.0f, static_cast<float>(i), 0.0f);
    stairs.emplace_back(i + 1.0f, i + 1.0f, 0.0f);
  }
  stairs.emplace_back(0.0f, 20.0f, 0.0f);
  expect_covered(stairs);
}

TEST(Polygon, ARingThatABridgeMakesOne) {
  Ring ring;
  for (int i = 0; i <= 32; ++i) ring.push_back(on_circle(2.0, i == 32 ? 0.0 : i / 32.0));
  for (int i = 32; i >= 0; --i) ring.push_back(on_circle(1.0, i == 32 ? 0.0 : i / 32.0));
  ASSERT_EQ(ring.size(), 66u);
  expect_covered(ring);
}

// Each outer corner's ear has an inner corner in it, which is found late: all of them fail at each cut.
Ring blocked_ring(std::size_t corners) {
  const double poke = 0.5 * (1.0 + std::cos(2.0 * std::numbers::pi / static_cast<double>(corners)));
  Ring ring;
  for (std::size_t i = 0; i <= corners; ++i)
    ring.push_back(on_circle(1.0, static_cast<double>(i % corners) / static_cast<double>(corners)));
  for (std::size_t i = corners + 1; i-- > 0;)
    ring.push_back(on_circle(poke, static_cast<double>(i % corners) / static_cast<double>(corners)));
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(corners) + 1,
              ring[corners + 1]);  // too much for the sweep
  return ring;
}

TEST(Polygon, EarsTakeTheSquareOfTheCorners) {
  for (const std::size_t corners : {50u, 100u, 200u, 400u}) {
    const Ring ring = blocked_ring(corners);
    expect_covered(ring);
    const std::size_t steps = triangulate(ring).ear_steps;
    EXPECT_GT(steps, 0u);
    EXPECT_LE(steps, 3 * ring.size() * ring.size()) << corners;
  }
}

TEST(Polygon, RandomStarsInSpace) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const std::size_t corners = 5 + random.next() % 60;
    Ring ring;
    for (std::size_t i = 0; i < corners; ++i)
      ring.push_back(on_circle(0.5 + (random.next() % 1000) / 500.0,
                               static_cast<double>(i) / static_cast<double>(corners)));
    expect_covered(ring);
  }
}

TEST(Polygon, FortyThousandCorners) {
  const std::clock_t begin = std::clock();
  expect_covered(star(40000));
  expect_covered(comb(20000));
  EXPECT_LT(std::clock() - begin, 5 * CLOCKS_PER_SEC);  // of a processor; quadratic ones take minutes
}

TEST(Polygon, WhatCrossesItselfIsSaid) {
  EXPECT_FALSE(triangulate(Ring{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 3, 0}, {-1, 2, 0}}).simple);
  Random random(11);
  for (int k = 0; k < 300; ++k) {  // and nothing worse happens
    Ring ring;
    for (std::uint32_t n = 4 + random.next() % 30; n > 0; --n)
      ring.emplace_back(static_cast<float>(random.next() % 5), static_cast<float>(random.next() % 5), 0.0f);
    EXPECT_EQ(triangulate(ring).triangles.size(), ring.size() - 2);
  }
}

}  // namespace
}  // namespace pinocchio
