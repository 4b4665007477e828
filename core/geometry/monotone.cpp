#include "core/geometry/monotone.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Points = std::span<const glm::dvec2>;

// The sweep goes down; among points of equal height the left one counts as higher.
bool above(Points p, std::uint32_t a, std::uint32_t b) {
  if (p[a].y != p[b].y) return p[a].y > p[b].y;
  if (p[a].x != p[b].x) return p[a].x < p[b].x;
  return a < b;
}

std::vector<std::uint32_t> sorted_down(Points p, std::vector<std::uint32_t> corners) {
  std::sort(corners.begin(), corners.end(), [p](std::uint32_t a, std::uint32_t b) { return above(p, a, b); });
  return corners;
}

// Edges by the index of their upper end, the interior on their right; ordered from left to right at the
// sweep.
struct Crossing {
  struct Point {
    std::uint32_t at;
  };
  using is_transparent = void;
  Points p;

  [[nodiscard]] std::uint32_t lower_end(std::uint32_t edge) const { return (edge + 1) % as_uint32(p.size()); }
  // Positive: `q` is on the left of the edge.
  [[nodiscard]] double side(std::uint32_t edge, std::uint32_t q) const {
    return turn(p[lower_end(edge)], p[edge], p[q]);
  }

  bool operator()(std::uint32_t a, std::uint32_t b) const {
    if (a == b) return false;
    const bool a_is_longer = above(p, a, b);
    const std::uint32_t edge = a_is_longer ? a : b, other = a_is_longer ? b : a;
    double s = side(edge, other);
    if (s == 0.0) s = side(edge, lower_end(other));
    if (s == 0.0) return a < b;
    return (s < 0.0) == a_is_longer;
  }
  bool operator()(std::uint32_t edge, Point q) const { return side(edge, q.at) < 0.0; }
  bool operator()(Point q, std::uint32_t edge) const { return side(edge, q.at) > 0.0; }
};

struct Diagonal {
  std::uint32_t a, b;
};

// The diagonals that cut the polygon into monotone pieces.
class Sweep {
 public:
  explicit Sweep(Points p)
      : p_(p),
        n_(as_uint32(p.size())),
        status_(Crossing{p}),
        helper_(p.size()),
        in_(p.size(), status_.end()) {}

  std::vector<Diagonal> run() {
    std::vector<std::uint32_t> all(n_);
    std::iota(all.begin(), all.end(), 0u);
    for (const std::uint32_t v : sorted_down(p_, std::move(all))) visit(v);
    return std::move(diagonals_);
  }

 private:
  enum class Kind { start, split, end, merge, left, right };

  [[nodiscard]] std::uint32_t before(std::uint32_t v) const { return (v + n_ - 1) % n_; }
  [[nodiscard]] std::uint32_t after(std::uint32_t v) const { return (v + 1) % n_; }

  [[nodiscard]] Kind kind(std::uint32_t v) const {
    const bool over_before = above(p_, v, before(v)), over_after = above(p_, v, after(v));
    const bool convex = turn(p_[before(v)], p_[v], p_[after(v)]) > 0.0;
    if (over_before && over_after) return convex ? Kind::start : Kind::split;
    if (!over_before && !over_after) return convex ? Kind::end : Kind::merge;
    return over_after ? Kind::left : Kind::right;  // on the left chain the interior is to the right
  }

  void visit(std::uint32_t v) {
    const Kind k = kind(v);
    if (k == Kind::end || k == Kind::merge || k == Kind::left) close(before(v), v);
    if (k == Kind::split || k == Kind::merge || k == Kind::right) {
      auto left = status_.lower_bound(Crossing::Point{v});
      if (left != status_.begin()) {
        const std::uint32_t edge = *--left;
        if (k == Kind::split || kind(helper_[edge]) == Kind::merge) connect(v, helper_[edge]);
        helper_[edge] = v;
      }
    }
    if (k == Kind::start || k == Kind::split || k == Kind::left) {
      in_[v] = status_.insert(v).first;
      helper_[v] = v;
    }
  }

  void close(std::uint32_t edge, std::uint32_t v) {
    if (in_[edge] == status_.end()) return;
    if (kind(helper_[edge]) == Kind::merge) connect(v, helper_[edge]);
    if (*in_[edge] == edge) status_.erase(in_[edge]);
    in_[edge] = status_.end();
  }

  void connect(std::uint32_t a, std::uint32_t b) {
    if (a != b && after(a) != b && after(b) != a) diagonals_.push_back({a, b});
  }

  Points p_;
  std::uint32_t n_;
  std::set<std::uint32_t, Crossing> status_;
  std::vector<std::uint32_t> helper_;
  std::vector<std::set<std::uint32_t, Crossing>::iterator> in_;
  std::vector<Diagonal> diagonals_;
};

// Follows the pieces that diagonals cut a polygon into.
class Pieces {
 public:
  Pieces(Points p, const std::vector<Diagonal>& diagonals)
      : p_(p), n_(as_uint32(p.size())), first_(p.size() + 1, 0) {
    for (std::uint32_t v = 0; v <= n_; ++v)
      first_[v] = v;  // the edge to the next corner, before its diagonals
    std::vector<std::uint32_t> count(p.size(), 0);
    for (const Diagonal& d : diagonals) ++count[d.a], ++count[d.b];
    for (std::uint32_t v = 0, sum = 0; v < n_; ++v) first_[v + 1] += sum += count[v];
    to_.resize(first_[n_]);
    std::fill(count.begin(), count.end(), 1u);
    for (std::uint32_t v = 0; v < n_; ++v) to_[first_[v]] = (v + 1) % n_;
    for (const Diagonal& d : diagonals) {
      to_[first_[d.a] + count[d.a]++] = d.b;
      to_[first_[d.b] + count[d.b]++] = d.a;
    }
    for (std::uint32_t v = 0; v < n_; ++v) sort_around(v);
  }

  template <class Take>
  void each(Take take) const {
    std::vector<bool> seen(to_.size(), false);
    std::vector<std::uint32_t> piece;
    for (std::uint32_t start = 0; start < n_; ++start)
      for (std::uint32_t e = first_[start]; e < first_[start + 1]; ++e) {
        if (seen[e]) continue;
        piece.clear();
        std::uint32_t from = start, edge = e;
        while (!seen[edge]) {
          seen[edge] = true;
          piece.push_back(from);
          const std::uint32_t at = to_[edge];
          edge = following(from, at);
          from = at;
        }
        take(piece);
      }
  }

 private:
  // Counterclockwise, starting with the edge to the next corner.
  void sort_around(std::uint32_t v) {
    const glm::dvec2 o = p_[v], zero = p_[to_[first_[v]]];
    const auto behind = [&](std::uint32_t q) {
      const double t = turn(o, zero, p_[q]);
      return t < 0.0 || (t == 0.0 && glm::dot(zero - o, p_[q] - o) < 0.0);
    };
    std::sort(to_.begin() + first_[v] + 1, to_.begin() + first_[v + 1],
              [&](std::uint32_t a, std::uint32_t b) {
                if (behind(a) != behind(b)) return behind(b);
                const double t = turn(o, p_[a], p_[b]);
                return t != 0.0 ? t > 0.0 : a < b;
              });
  }

  // The edge with which the piece on the left of from -> at continues: clockwise the next from at -> from.
  [[nodiscard]] std::uint32_t following(std::uint32_t from, std::uint32_t at) const {
    if ((from + 1) % n_ == at) return first_[at + 1] - 1;
    const auto begin = to_.begin() + first_[at], end = to_.begin() + first_[at + 1];
    const auto back = std::find(begin + 1, end, from);
    return back == end ? first_[at] : as_uint32(back - to_.begin()) - 1;
  }

  Points p_;
  std::uint32_t n_;
  std::vector<std::uint32_t> first_, to_;  // ends of the edges that leave each corner
};

// Appends the triangles of a monotone piece, whose corners are counterclockwise.
void triangulate_piece(Points p, const std::vector<std::uint32_t>& piece,
                       std::vector<glm::uvec3>& triangles) {
  const std::size_t m = piece.size();
  if (m < 3) return;
  std::vector<std::uint32_t> order(m);  // positions in the piece, going down
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return above(p, piece[a], piece[b]); });
  // The left chain goes down from the top to the bottom as the corners follow.
  std::vector<bool> on_left(m, false);
  for (std::size_t i = order[0]; i != order[m - 1]; i = (i + 1) % m) on_left[i] = true;
  const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const bool left = turn(p[piece[a]], p[piece[b]], p[piece[c]]) >= 0.0;
    triangles.emplace_back(piece[a], piece[left ? b : c], piece[left ? c : b]);
  };
  std::vector<std::uint32_t> stack{order[0], order[1]};
  for (std::size_t j = 2; j < m; ++j) {
    const std::uint32_t v = order[j];
    if (j == m - 1 || on_left[v] != on_left[stack.back()]) {
      for (std::size_t k = 0; k + 1 < stack.size(); ++k) emit(v, stack[k], stack[k + 1]);
      stack = {stack.back(), v};
      continue;
    }
    std::uint32_t last = stack.back();
    stack.pop_back();
    while (!stack.empty()) {
      const double t = turn(p[piece[stack.back()]], p[piece[last]], p[piece[v]]);
      if (on_left[v] ? t <= 0.0 : t >= 0.0) break;
      emit(v, stack.back(), last);
      last = stack.back();
      stack.pop_back();
    }
    stack.push_back(last);
    stack.push_back(v);
  }
}

}  // namespace

std::vector<glm::uvec3> triangulate_by_sweep(std::span<const glm::dvec2> polygon) {
  std::vector<glm::uvec3> triangles;
  triangles.reserve(polygon.size());
  Pieces(polygon, Sweep(polygon).run()).each([&](const std::vector<std::uint32_t>& piece) {
    triangulate_piece(polygon, piece, triangles);
  });
  return triangles;
}

}  // namespace pinocchio
