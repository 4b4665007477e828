#include "pinocchio/animation.h"

#include <algorithm>
#include <cmath>

#include "core/base/decimal.h"
#include "core/scene/pose/pose.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

glm::dquat quaternion(const float* xyzw) {
  return {as_double(xyzw[3]), as_double(xyzw[0]), as_double(xyzw[1]), as_double(xyzw[2])};
}

// Zero becomes no rotation.
glm::dquat unit(const glm::dquat& q) {
  return std::isfinite(glm::length(q)) ? glm::normalize(q) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

void store(const glm::dquat& q, float* xyzw) {
  for (int i = 0; i < 4; ++i) xyzw[i] = as_float(i < 3 ? q[i] : q.w);
}

// Hermite weights of value, tangent, next value and next tangent; tangents are per second.
struct Hermite {
  double p0, m0, p1, m1;
  Hermite(double t, double span_s)
      : p0((2.0 * t - 3.0) * t * t + 1.0),
        m0(((t - 2.0) * t + 1.0) * t * span_s),
        p1((3.0 - 2.0 * t) * t * t),
        m1((t - 1.0) * t * t * span_s) {}
};

void apply(const Track& track, double seconds, NodeMotion& motion, std::vector<float>& weights) {
  std::vector<float> value(track.width);
  track.sample(seconds, value);
  switch (track.path) {
    case Track::Path::translation:
      motion.translation = {value[0], value[1], value[2]};
      break;
    case Track::Path::rotation:
      motion.rotation = unit(quaternion(value.data()));
      break;
    case Track::Path::scale:
      motion.scale = {value[0], value[1], value[2]};
      break;
    case Track::Path::weights:
      weights = std::move(value);
      break;
  }
}

// The animated nodes and their descendants.
NodeFlags moving(const Animation& animation, const NodeTree& tree) {
  NodeFlags flags(tree.nodes.size(), false);
  for (const AnimatedNode& animated : animation.nodes) flags[animated.node] = true;
  for (std::size_t n = 0; n < flags.size(); ++n)
    if (const int parent = tree.nodes[n].parent; parent >= 0 && flags[parent]) flags[n] = true;
  return flags;
}

std::shared_ptr<const NodeTree> tree_at(const Scene& scene, double seconds) {
  auto tree = std::make_shared<NodeTree>(*scene.nodes);
  for (const AnimatedNode& animated : scene.animation->nodes) {
    NodeMotion motion = animated.at_rest;
    std::vector<float> weights;
    bool moves = false;
    for (const Track& track : animated.tracks) {
      apply(track, seconds, motion, weights);
      moves = moves || track.path != Track::Path::weights;
    }
    if (moves) tree->nodes[animated.node].local = motion.matrix();
    if (weights.empty()) continue;
    for (std::size_t d = 0; d < tree->weights.size(); ++d)
      if (tree->rest->deformations[d].node == animated.node) tree->weights[d] = std::move(weights);
  }
  return tree;
}

}  // namespace

void Track::sample(double seconds, std::vector<float>& to) const {
  const bool cubic = interpolation == Interpolation::cubic_spline;
  const auto value = [&](std::size_t key) { return values.data() + (cubic ? 3 * key + 1 : key) * width; };
  const auto after = std::upper_bound(times_s.begin(), times_s.end(), seconds,
                                      [](double s, float key_s) { return s < key_s; });
  const auto next = as_size(after - times_s.begin());
  const std::size_t key = next == 0 ? 0 : next - 1;
  if (next == 0 || next == times_s.size() || interpolation == Interpolation::step) {
    std::copy_n(value(key), width, to.begin());
    return;
  }
  const double begin_s = times_s[key], span_s = times_s[next] - begin_s;
  const double t = (seconds - begin_s) / span_s;
  if (!cubic && path == Path::rotation) {
    store(glm::slerp(unit(quaternion(value(key))), unit(quaternion(value(next))), t), to.data());
    return;
  }
  const Hermite h(t, span_s);
  for (std::size_t i = 0; i < width; ++i) {
    const float *a = value(key) + i, *b = value(next) + i;
    const double p0 = as_double(*a), p1 = as_double(*b);
    // In a spline, a value is between its in-tangent and its out-tangent.
    to[i] = as_float(cubic ? h.p0 * p0 + h.m0 * as_double(*(a + width)) + h.p1 * p1 +
                                 h.m1 * as_double(*(b - width))
                           : p0 + t * (p1 - p0));
  }
}

glm::mat4 NodeMotion::matrix() const {
  glm::mat4 m(1.0f);
  m[3] = glm::vec4(translation, 1.0f);
  if (rotation != glm::dquat(1.0, 0.0, 0.0, 0.0)) m *= glm::mat4(glm::mat4_cast(unit(rotation)));
  for (int i = 0; i < 3; ++i) m[i] *= scale[i];
  return m;
}

double duration_s(const Scene& scene) {
  return scene.animation ? scene.animation->duration_s : 0.0;
}

std::vector<Camera> cameras_at(const Scene& scene, double seconds) {
  Scene moved;
  moved.cameras = scene.cameras;
  if (!scene.animation || !scene.nodes || scene.nodes->rest->cameras.empty()) return moved.cameras;
  const std::shared_ptr<const NodeTree> tree = tree_at(scene, seconds);
  const NodeFlags flags = moving(*scene.animation, *tree);
  const std::vector<glm::mat4> world = world_matrices(tree->nodes);
  const AttachedPlaces places = attached_places(*tree->rest, moved);
  for (std::size_t n = 0; n < flags.size(); ++n)
    if (flags[n]) place_attached(*tree->rest, places, as_int(n), Placement(world[n]), moved);
  return moved.cameras;
}

Expected<Scene> at_time(const Scene& scene, double seconds) {
  if (!std::isfinite(seconds))
    return Unexpected(InputError{scene.source, 0, "the time " + decimal(seconds) + " s is not finite",
                                 "give a finite number"});
  if (!scene.animation || !scene.nodes) return scene;
  std::shared_ptr<const NodeTree> tree = tree_at(scene, seconds);
  const NodeFlags flags = moving(*scene.animation, *tree);
  return placed_anew(scene, std::move(tree), flags);
}

}  // namespace pinocchio
