#include "core/scene/sky/lat_long.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using glm::pi;

// The picture's light at a place between texels' centres.
glm::dvec3 light_at(const Image<glm::vec3>& picture, double u, double v) {
  const glm::ivec2 size = picture.size();
  const double x = u * size.x - 0.5, y = v * size.y - 0.5;
  const double column = std::floor(x), row = std::floor(y);
  const auto texel = [&](double c, double r) {
    const int i = as_int(c) % size.x;
    return glm::dvec3(picture.at(i < 0 ? i + size.x : i, std::clamp(as_int(r), 0, size.y - 1)));
  };
  return glm::mix(glm::mix(texel(column, row), texel(column + 1, row), x - column),
                  glm::mix(texel(column, row + 1), texel(column + 1, row + 1), x - column), y - row);
}

// The parts of texels that one of `to` instead of `from` texels holds, along one side.
struct Overlap {
  int first = 0;
  std::vector<double> ends;  // of its parts, from the first one's beginning, in texels of `from`
};
Overlap overlap_of(int texel, int from, int to) {
  const double scale = as_double(from) / to, lo = texel * scale, hi = (texel + 1) * scale;
  Overlap overlap{as_int(lo), {lo}};
  for (int edge = overlap.first + 1; edge < hi && edge < from; ++edge) overlap.ends.push_back(edge);
  overlap.ends.push_back(hi);
  return overlap;
}

}  // namespace

Image<glm::vec3> reduced(const Image<glm::vec3>& picture, glm::ivec2 size) {
  const auto steps = [](int from, int to) { return std::max(2, (from + to - 1) / to); };
  const int across = steps(picture.width(), size.x), down = steps(picture.height(), size.y);
  Image<glm::vec3> means(size);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      glm::dvec3 sum(0.0);
      double area = 0.0;
      for (int j = 0; j < down; ++j) {
        const double v = (y + (j + 0.5) / down) / size.y, sine = std::sin(pi<double>() * v);
        for (int i = 0; i < across; ++i)
          sum += sine * light_at(picture, (x + (i + 0.5) / across) / size.x, v);
        area += sine * across;
      }
      means.at(x, y) = glm::vec3(sum / area);
    }
  return means;
}

Image<glm::vec3> area_means(const Image<glm::vec3>& picture, glm::ivec2 size) {
  const auto height = as_double(picture.height());
  std::vector<Overlap> columns;
  for (int x = 0; x < size.x; ++x) columns.push_back(overlap_of(x, picture.width(), size.x));
  Image<glm::vec3> means(size);
  for (int y = 0; y < size.y; ++y) {
    const Overlap rows = overlap_of(y, picture.height(), size.y);
    const auto area_above = [&](double row) { return 1.0 - std::cos(pi<double>() * row / height); };
    for (int x = 0; x < size.x; ++x) {
      glm::dvec3 sum(0.0);
      double all = 0.0;
      for (std::size_t j = 0; j + 1 < rows.ends.size(); ++j) {
        const double tall = area_above(rows.ends[j + 1]) - area_above(rows.ends[j]);
        const std::vector<double>& ends = columns[as_size(x)].ends;
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
          const double area = tall * (ends[i + 1] - ends[i]);
          sum += area * glm::dvec3(picture.at(columns[as_size(x)].first + as_int(i), rows.first + as_int(j)));
          all += area;
        }
      }
      means.at(x, y) = glm::vec3(sum / all);
    }
  }
  return means;
}

}  // namespace pinocchio
