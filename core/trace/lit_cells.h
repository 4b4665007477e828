#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "core/parallel/workers.h"
#include "core/trace/shared.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// What earlier frames have taught about the lights: pieces of triangles (cells) that a light reaches as a
// whole, or that turn away from it as a whole. Their pixels need no shadow ray, not even their surface, and
// their mask bits are the ones that rays would give. A cell is looked into once its pixels have cost about
// as much as looking; a single ray that is blocked settles that it never is. Large triangles are cut into
// many cells. What is known holds for one side of a triangle, from wherever it is looked at, until a light
// changes.
//
// One pass at a time: begin_pass, then any thread may ask and note. What is known changes in begin_pass
// alone, so that a pass fires the same rays on any number of threads.
class LitCells {
 public:
  enum class Known : std::uint8_t { nothing, lit, turned_away };

  // Whether a tracer's rays are exact enough to be spared: an error bound as offset, no rounding in its
  // triangle test.
  [[nodiscard]] static bool suits(const Tracer& tracer);

  // The tracer stays where it is as long as this lives.
  explicit LitCells(const Tracer& tracer);

  // The casting lights in the order of mask slots, and the light below which no ray is fired. Looks into the
  // cells that are due, a bounded number of them. The pass lasts as long as what is returned.
  [[nodiscard]] std::unique_lock<std::mutex> begin_pass(std::span<const shared::LightParams> lights,
                                                        float least_light, Workers& workers);

  // One side of a triangle.
  struct Side {
    std::uint32_t first = 0;  // its first cell
    int cuts = 0;             // each edge is cut into so many; 0: nothing is known of it
    float edge = 0.0f;        // no cell has weights below this
    float scale = 0.0f;       // cells in a unit of weight
  };
  // The side that `eye` sees; nothing where the eye is too near the triangle's plane.
  [[nodiscard]] Side side_of(std::uint32_t triangle, const glm::vec3& eye) const;
  // Weights are those of the triangle's corners. Nothing close to its edges.
  [[nodiscard]] static std::optional<std::uint32_t> cell_of(const Side& side, const glm::vec3& weights);

  [[nodiscard]] Known known(std::uint32_t cell, std::size_t slot) const;
  // What is known alike of all cells between the points with these weights (in their convex hull).
  [[nodiscard]] Known known_between(const Side& side, std::span<const glm::vec3> weights,
                                    std::size_t slot) const;

  // A pixel of the cell and what became of its ray towards the light of a slot; none was needed: not blocked.
  struct Finding {
    std::uint32_t cell;
    std::uint8_t slot;
    bool blocked;
  };
  void note(std::span<const Finding> findings);

 private:
  struct Due {
    std::uint8_t slot;
    std::uint32_t cell;
    friend auto operator<=>(const Due&, const Due&) = default;
  };

  void cut_triangles();
  void forget_what_changed(std::span<const shared::LightParams> lights, float least_light);
  [[nodiscard]] std::uint8_t& state(const Due& due) { return states_[due.slot * cells_ + due.cell]; }
  void look_into(const Due& due);
  [[nodiscard]] bool falls(std::uint32_t triangle) const;
  [[nodiscard]] ProjectedTriangle projected(std::uint32_t triangle) const;

  const Tracer& tracer_;
  std::vector<std::uint32_t> first_;  // a triangle's first cell; those of its other side follow
  std::vector<std::uint8_t> cuts_;
  std::size_t cells_ = 0;
  float cell_size_ = 0.0f, diagonal_ = 0.0f;  // scene units
  std::vector<shared::LightParams> lights_;
  float least_light_ = 0.0f;
  std::vector<std::uint8_t> states_;  // [slot][cell]: pixels counted, or one of the ends (lit_cells.cpp)
  std::mutex pass_;
  std::mutex noting_;  // of due_
  std::vector<Due> due_;
};

}  // namespace pinocchio
