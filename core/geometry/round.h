// Points and lines as triangles: balls, and tubes with round ends. A tube is closed by itself, so that tubes
// that meet at any angle leave no gap.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace pinocchio {

// How finely they are divided.
struct RoundDetail {
  int ball_triangles, ball_vertices;
  int sides, rings;  // of a tube; circles of vertices from an end's equator to its pole
  // The largest distance of a silhouette from the ideal one, as a fraction of the diameter. A test measures
  // it.
  double error;

  [[nodiscard]] int tube_triangles() const { return 4 * sides * rings; }
  [[nodiscard]] int tube_vertices() const { return 2 * (sides * rings + 1); }
};
inline constexpr std::array<RoundDetail, 5> kRoundDetails{{{8, 6, 4, 1, 0.174},
                                                           {20, 12, 6, 2, 0.0729},
                                                           {80, 42, 8, 2, 0.026},
                                                           {320, 162, 16, 4, 0.0065},
                                                           {1280, 642, 32, 8, 0.00161}}};

// The index of the coarsest detail whose error is at most half a pixel where `count` shapes, side by side,
// fill a picture of 1000 x 1000 pixels.
[[nodiscard]] int round_detail_for(double count);

// A surface of unit radius. Its size is such that its projections have the mean area (of tubes, the mean
// width) of the ideal shape's.
struct RoundShape {
  std::vector<glm::vec3> normals;  // a vertex is `reach` times its normal from its end's centre
  std::vector<std::uint8_t> ends;  // of each vertex: 0 or 1; balls have end 0 alone
  std::vector<glm::uvec3> triangles;
  float reach = 1.0f;
};
// `detail`: index of kRoundDetails.
[[nodiscard]] RoundShape round_ball(int detail);
// The line goes from end 0 to end 1 along +z.
[[nodiscard]] RoundShape round_tube(int detail);

// A rotation whose third column is the unit vector `axis`.
[[nodiscard]] glm::mat3 frame_along(const glm::vec3& axis);

}  // namespace pinocchio
