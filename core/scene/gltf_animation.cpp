#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <set>

#include "core/scene/gltf_deformation.h"

namespace pinocchio {
namespace {

constexpr const char* kStill = "it stands still there";

struct NamedPath {
  const char* name;
  Track::Path path;
  std::size_t width;
};
constexpr NamedPath kPaths[] = {{"translation", Track::Path::translation, 3},
                                {"rotation", Track::Path::rotation, 4},
                                {"scale", Track::Path::scale, 3},
                                {"weights", Track::Path::weights, 0}};

class AnimationReader {
 public:
  AnimationReader(const GltfFile& file, const NodeTree& tree, const std::vector<int>& place_of_node,
                  Warnings& warnings)
      : file_(file), tree_(tree), place_of_node_(place_of_node), warnings_(warnings) {}

  Expected<std::shared_ptr<const Animation>> read() {
    for (std::size_t i = 0; i < file_.model.animations.size(); ++i) {
      const tinygltf::Animation& from = file_.model.animations[i];
      where_ = "animation " + (from.name.empty() ? std::to_string(i) : "'" + from.name + "'");
      if (const Expected<void> added = add(from); !added) return Unexpected(added.error());
    }
    if (nodes_.empty()) return std::shared_ptr<const Animation>();
    for (auto& [index, node] : nodes_) result_.nodes.push_back(std::move(node));
    for (const Animation::Clip& clip : result_.clips)
      result_.duration_s = std::max(result_.duration_s, clip.duration_s);
    return std::make_shared<const Animation>(std::move(result_));
  }

 private:
  using Moved = std::pair<int, Track::Path>;  // node of the scene, what of it

  Expected<void> add(const tinygltf::Animation& from) {
    if (moves_what_is_moved(from)) {
      warn("animations of what an earlier one moves are left out", "the first one is shown");
      return {};
    }
    Animation::Clip clip{from.name};
    bool any = false;
    for (const tinygltf::AnimationChannel& channel : from.channels) {
      throw_if_cancelled(file_.progress);
      Expected<std::optional<Track>> track = track_of(from, channel);
      if (!track) return Unexpected(track.error());
      if (!*track) continue;
      clip.duration_s = std::max(clip.duration_s, static_cast<double>((*track)->times_s.back()));
      const int node = place_of(channel);
      if (!moved_.emplace(node, (*track)->path).second) {
        warn("a second channel of the same node is left out", "the first one is shown");
        continue;
      }
      (*track)->clip = result_.clips.size();
      node_of(node, channel.target_node).tracks.push_back(std::move(**track));
      any = true;
    }
    if (any) result_.clips.push_back(std::move(clip));
    return {};
  }

  [[nodiscard]] bool moves_what_is_moved(const tinygltf::Animation& from) const {
    return std::ranges::any_of(from.channels, [&](const tinygltf::AnimationChannel& channel) {
      const NamedPath* path = path_of(channel);
      return path && moved_.contains({place_of(channel), path->path});
    });
  }

  // Nothing where it moves nothing that is drawn, or is left out with a warning.
  Expected<std::optional<Track>> track_of(const tinygltf::Animation& from,
                                          const tinygltf::AnimationChannel& channel) {
    const auto none = [] { return std::optional<Track>(); };
    const NamedPath* path = path_of(channel);
    if (!path || channel.target_node < 0) return none();  // of an extension
    if (static_cast<std::size_t>(channel.target_node) >= place_of_node_.size())
      return file_.error(where_ + " moves node " + std::to_string(channel.target_node) + ", there are " +
                         std::to_string(place_of_node_.size()));
    if (place_of(channel) < 0) return none();  // it is in no scene that is drawn
    if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= from.samplers.size())
      return file_.error(where_ + " names sampler " + std::to_string(channel.sampler) + ", it has " +
                         std::to_string(from.samplers.size()));
    if (path->path != Track::Path::weights &&
        file_.model.nodes[static_cast<std::size_t>(channel.target_node)].matrix.size() == 16)
      return left_out("channels of nodes that have a matrix are left out");
    const std::size_t width =
        path->path == Track::Path::weights ? targets_of(place_of(channel)) : path->width;
    if (width == 0) return left_out("weights of a node without morph targets are left out");
    return sampled(from.samplers[static_cast<std::size_t>(channel.sampler)], *path, width);
  }

  Expected<std::optional<Track>> sampled(const tinygltf::AnimationSampler& sampler, const NamedPath& path,
                                         std::size_t width) {
    Track track;
    track.path = path.path;
    track.width = width;
    if (sampler.interpolation == "STEP")
      track.interpolation = Track::Interpolation::step;
    else if (sampler.interpolation == "CUBICSPLINE")
      track.interpolation = Track::Interpolation::cubic_spline;
    else if (sampler.interpolation != "LINEAR")
      return left_out("channels of an unknown interpolation are left out");
    // Many channels may name one accessor.
    for (const int accessor : {sampler.input, sampler.output})
      if (accessor >= 0 && static_cast<std::size_t>(accessor) < file_.model.accessors.size() &&
          !file_.limit->take(file_.path.string(), where_,
                             file_.model.accessors[static_cast<std::size_t>(accessor)].count,
                             4 * sizeof(float)))
        return Unexpected(*file_.limit->error());
    Expected<std::vector<float>> times = file_.floats(sampler.input, 1);
    if (!times) return Unexpected(times.error());
    Expected<std::vector<float>> values =
        file_.floats(sampler.output, path.path == Track::Path::weights ? 1 : static_cast<int>(width));
    if (!values) return Unexpected(values.error());
    const auto finite = [](float f) { return std::isfinite(f); };
    if (!std::ranges::all_of(*times, finite) || !std::ranges::all_of(*values, finite))
      return left_out("channels of numbers that are not finite are left out");
    if (times->empty() || !std::ranges::is_sorted(*times))
      return left_out("channels whose times do not rise are left out");
    const std::size_t each = track.interpolation == Track::Interpolation::cubic_spline ? 3 * width : width;
    if (values->size() != times->size() * each)
      return left_out("channels without a value for each time are left out");
    track.times_s = std::move(*times);
    track.values = std::move(*values);
    return std::optional(std::move(track));
  }

  std::optional<Track> left_out(const std::string& what) {
    warn(what, kStill);
    return std::nullopt;
  }

  void warn(const std::string& what, const std::string& lost) {
    warnings_.add({file_.path.string(), where_, what, lost});
  }

  [[nodiscard]] static const NamedPath* path_of(const tinygltf::AnimationChannel& channel) {
    const auto* found =
        std::ranges::find_if(kPaths, [&](const NamedPath& p) { return channel.target_path == p.name; });
    return found == std::end(kPaths) ? nullptr : found;
  }

  [[nodiscard]] int place_of(const tinygltf::AnimationChannel& channel) const {
    const auto n = static_cast<std::size_t>(channel.target_node);
    return channel.target_node >= 0 && n < place_of_node_.size() ? place_of_node_[n] : -1;
  }

  [[nodiscard]] std::size_t targets_of(int node) const {
    const auto found = std::ranges::find(tree_.rest->deformations, node, &Deformation::node);
    return found == tree_.rest->deformations.end() ? 0 : found->targets.size();
  }

  AnimatedNode& node_of(int node, int in_file) {
    const auto [at, is_new] = nodes_.try_emplace(node);
    if (is_new) at->second = {node, gltf_motion(file_.model.nodes[static_cast<std::size_t>(in_file)]), {}};
    return at->second;
  }

  const GltfFile& file_;
  const NodeTree& tree_;
  const std::vector<int>& place_of_node_;
  Warnings& warnings_;
  std::string where_;
  std::set<Moved> moved_;
  std::map<int, AnimatedNode> nodes_;
  Animation result_;
};

}  // namespace

NodeMotion gltf_motion(const tinygltf::Node& node) {
  NodeMotion motion;
  if (node.translation.size() == 3) motion.translation = glm::vec3(glm::make_vec3(node.translation.data()));
  if (const std::vector<double>& r = node.rotation; r.size() == 4)
    motion.rotation = glm::dquat(r[3], r[0], r[1], r[2]);
  if (node.scale.size() == 3) motion.scale = glm::vec3(glm::make_vec3(node.scale.data()));
  return motion;
}

Expected<std::shared_ptr<const Animation>> gltf_animation(const GltfFile& file, const NodeTree& tree,
                                                          const std::vector<int>& place_of_node,
                                                          Warnings& warnings) {
  return AnimationReader(file, tree, place_of_node, warnings).read();
}

}  // namespace pinocchio
