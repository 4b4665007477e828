#include "app/window/scene/clips.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pinocchio::app {
namespace {

// What the track moves, where nothing moves it.
std::vector<float> at_rest(const AnimatedNode& node, Track::Path path, const NodeTree& rest) {
  const NodeMotion& motion = node.at_rest;
  switch (path) {
    case Track::Path::translation:
      return {motion.translation.x, motion.translation.y, motion.translation.z};
    case Track::Path::rotation: {
      const glm::quat q(motion.rotation);
      return {q.x, q.y, q.z, q.w};
    }
    case Track::Path::scale:
      return {motion.scale.x, motion.scale.y, motion.scale.z};
    case Track::Path::weights:
      break;
  }
  for (std::size_t d = 0; d < rest.weights.size(); ++d)
    if (rest.rest->deformations[d].node == node.node) return rest.weights[d];
  return {};
}

}  // namespace

std::shared_ptr<const Animation> clip_of(const Animation& all, std::size_t clip, const NodeTree& rest) {
  auto one = std::make_shared<Animation>();
  one->clips = {all.clips.at(clip)};
  one->duration_s = one->clips.front().duration_s;
  for (const AnimatedNode& node : all.nodes) {
    AnimatedNode kept{node.node, node.at_rest, {}};
    for (const Track& track : node.tracks)
      if (track.clip == clip) kept.tracks.push_back(track);
    for (const Track& track : node.tracks) {
      const auto has_path = [&](const Track& other) { return other.path == track.path; };
      if (std::ranges::any_of(kept.tracks, has_path)) continue;
      Track still;
      still.path = track.path;
      still.interpolation = Track::Interpolation::step;
      still.times_s = {0.0f};
      still.values = at_rest(node, track.path, rest);
      still.width = still.values.size();
      if (still.width == track.width) kept.tracks.push_back(std::move(still));
    }
    one->nodes.push_back(std::move(kept));
  }
  return one;
}

}  // namespace pinocchio::app
