#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "core/base/listed.h"
#include "core/scene/gltf/deformation.h"
#include "core/scene/gltf/format/json.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

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

const NamedPath* path_named(std::string_view name) {
  const auto* const found = std::ranges::find_if(kPaths, [&](const NamedPath& p) { return name == p.name; });
  return found == std::end(kPaths) ? nullptr : found;
}

// A channel of an animation; indices are the file's.
struct Channel {
  int sampler, node;
  const NamedPath* path;  // null: not one of glTF's own
  std::string pointer;    // KHR_animation_pointer's, where it names no part of a node that can move

  explicit Channel(const Json& json)
      : sampler(index_member(&json, "sampler")), node(index_member(member(&json, "target"), "node")) {
    const Json* const target = member(&json, "target");
    const std::string name = text_member(target, "path");
    path = path_named(name);
    if (name == "pointer") point_to(text_member(extension(target, "KHR_animation_pointer"), "pointer"));
  }

 private:
  // "/nodes/3/translation" is the same as a channel of node 3.
  void point_to(const std::string& text) {
    constexpr std::string_view kNodes = "/nodes/";
    const std::size_t end = text.rfind('/');
    if (text.starts_with(kNodes) && end > kNodes.size()) {
      const char *const first = text.data() + kNodes.size(), *const last = text.data() + end;
      int number = -1;
      const auto [stop, error] = std::from_chars(first, last, number);
      path = path_named(std::string_view(text).substr(end + 1));
      if (path && error == std::errc() && stop == last && number >= 0) {
        node = number;
        return;
      }
    }
    path = nullptr;
    pointer = text;
  }
};

// "/materials/3/emissiveFactor" as "/materials/N/emissiveFactor", so that each kind is one warning.
std::string kind_of(const std::string& pointer) {
  std::string kind;
  for (std::size_t i = 0; i < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', i + 1), pointer.size());
    const std::string part = pointer.substr(i, end - i);
    const bool is_number = part.size() > 1 && part.find_first_not_of("0123456789", 1) == std::string::npos;
    kind += is_number ? "/N" : part;
    i = end;
  }
  return kind;
}

class AnimationReader {
 public:
  AnimationReader(const GltfFile& file, const NodeTree& tree, const std::vector<int>& place_of_node,
                  Warnings& warnings, const std::string& chosen)
      : file_(file), tree_(tree), place_of_node_(place_of_node), warnings_(warnings), chosen_(chosen) {}

  Expected<std::shared_ptr<const Animation>> read() {
    const Json& animations = file_.items("animations");
    const std::optional<std::size_t> only = chosen_.empty() ? std::nullopt : place_of_chosen(animations);
    if (!chosen_.empty() && !only) return no_such_animation(animations);
    for (std::size_t i = 0; i < animations.size(); ++i) {
      if (only && i != *only) continue;
      const std::string name = text_member(&animations[i], "name");
      where_ = "animation " + (name.empty() ? std::to_string(i) : "'" + name + "'");
      if (const Expected<void> added = add(name, animations[i]); !added) return Unexpected(added.error());
    }
    if (nodes_.empty()) return std::shared_ptr<const Animation>();
    for (auto& [index, node] : nodes_) result_.nodes.push_back(std::move(node));
    for (const Animation::Clip& clip : result_.clips)
      result_.duration_s = std::max(result_.duration_s, clip.duration_s);
    return std::make_shared<const Animation>(std::move(result_));
  }

 private:
  using Moved = std::pair<int, Track::Path>;  // a node of the scene

  // By name, else by number.
  [[nodiscard]] std::optional<std::size_t> place_of_chosen(const Json& animations) const {
    for (std::size_t i = 0; i < animations.size(); ++i)
      if (text_member(&animations[i], "name") == chosen_) return i;
    std::size_t number = 0;
    const char* const end = chosen_.data() + chosen_.size();
    const auto [last, error] = std::from_chars(chosen_.data(), end, number);
    const bool is_number = error == std::errc() && last == end;
    return is_number && number < animations.size() ? std::optional(number) : std::nullopt;
  }

  [[nodiscard]] Unexpected no_such_animation(const Json& animations) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < animations.size(); ++i) {
      const std::string name = text_member(&animations[i], "name");
      names.push_back(std::to_string(i) + (name.empty() ? "" : " '" + name + "'"));
    }
    return file_.error("has no animation '" + chosen_ + "'",
                       names.empty() ? "it has none" : "choose from " + listed(names, ", ", " or "));
  }

  Expected<void> add(const std::string& name, const Json& from) {
    std::vector<Channel> channels;
    for (const Json& channel : array_member(&from, "channels")) channels.emplace_back(channel);
    const auto moves_what_is_moved = [this](const Channel& channel) {
      return channel.path && moved_.contains({place_of(channel), channel.path->path});
    };
    if (std::ranges::any_of(channels, moves_what_is_moved)) {
      warn("animations that move the same thing as an earlier one are left out", "the first one is shown");
      return {};
    }
    Animation::Clip clip{name};
    bool any = false;
    for (const Channel& channel : channels) {
      throw_if_cancelled(file_.progress);
      Expected<std::optional<Track>> track = track_of(array_member(&from, "samplers"), channel);
      if (!track) return Unexpected(track.error());
      if (!*track) continue;
      clip.duration_s = std::max(clip.duration_s, as_double((*track)->times_s.back()));
      const int node = place_of(channel);
      if (!moved_.emplace(node, (*track)->path).second) {
        warn("a second animation channel for the same property of a node is left out",
             "the first one is shown");
        continue;
      }
      (*track)->clip = result_.clips.size();
      node_of(node, channel.node).tracks.push_back(std::move(**track));
      any = true;
    }
    if (any) result_.clips.push_back(std::move(clip));
    return {};
  }

  // None: it moves nothing that is drawn, or is left out with a warning.
  Expected<std::optional<Track>> track_of(const Json& samplers, const Channel& channel) {
    const auto none = [] { return std::optional<Track>(); };
    if (!channel.pointer.empty())
      return left_out("KHR_animation_pointer to " + kind_of(channel.pointer) + " is left out");
    if (!channel.path || channel.node < 0) return none();  // an extension's
    if (!in_range(channel.node, place_of_node_))
      return file_.error(where_ + " moves node " + which_of(channel.node, place_of_node_));
    if (place_of(channel) < 0) return none();  // it is in no scene that is drawn
    if (channel.sampler < 0) return left_out("channels that name no sampler are left out");
    if (!in_range(channel.sampler, samplers))
      return file_.error(where_ + " names sampler " + std::to_string(channel.sampler) + ", it has " +
                         std::to_string(samplers.size()));
    const Track::Path path = channel.path->path;
    if (path != Track::Path::weights && item_of(file_.nodes, channel.node).matrix)
      return left_out("channels of nodes that have a matrix are left out");
    const std::size_t width =
        path == Track::Path::weights ? targets_of(place_of(channel)) : channel.path->width;
    if (width == 0) return left_out("weights of a node without morph targets are left out");
    return sampled(item_of(samplers, channel.sampler), path, width);
  }

  Expected<std::optional<Track>> sampled(const Json& sampler, Track::Path path, std::size_t width) {
    Track track;
    track.path = path;
    track.width = width;
    const std::string interpolation = text_member(&sampler, "interpolation");
    if (interpolation == "STEP")
      track.interpolation = Track::Interpolation::step;
    else if (interpolation == "CUBICSPLINE")
      track.interpolation = Track::Interpolation::cubic_spline;
    else if (!interpolation.empty() && interpolation != "LINEAR")
      return left_out("channels of an unknown interpolation are left out");
    const int input = index_member(&sampler, "input"), output = index_member(&sampler, "output");
    // Many channels may name one accessor.
    for (const int accessor : {input, output})
      if (in_range(accessor, file_.accessors) &&
          !file_.limit->take(file_.path.string(), where_, item_of(file_.accessors, accessor).count,
                             4 * sizeof(float)))
        return Unexpected(*file_.limit->error());
    Expected<std::vector<float>> times = file_.floats(input, 1);
    if (!times) return Unexpected(times.error());
    Expected<std::vector<float>> values =
        file_.floats(output, path == Track::Path::weights ? 1 : as_int(width));
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

  [[nodiscard]] int place_of(const Channel& channel) const {
    return in_range(channel.node, place_of_node_) ? item_of(place_of_node_, channel.node) : -1;
  }

  [[nodiscard]] std::size_t targets_of(int node) const {
    const auto found = std::ranges::find(tree_.rest->deformations, node, &Deformation::node);
    return found == tree_.rest->deformations.end() ? 0 : found->targets.size();
  }

  AnimatedNode& node_of(int node, int in_file) {
    const auto [at, is_new] = nodes_.try_emplace(node);
    if (is_new) at->second = {node, item_of(file_.nodes, in_file).motion, {}};
    return at->second;
  }

  const GltfFile& file_;
  const NodeTree& tree_;
  const std::vector<int>& place_of_node_;
  Warnings& warnings_;
  const std::string& chosen_;  // the name or the number of the only one that is read; empty: all are
  std::string where_;
  std::set<Moved> moved_;
  std::map<int, AnimatedNode> nodes_;
  Animation result_;
};

}  // namespace

Expected<std::shared_ptr<const Animation>> gltf_animation(const GltfFile& file, const NodeTree& tree,
                                                          const std::vector<int>& place_of_node,
                                                          Warnings& warnings, const std::string& chosen) {
  return AnimationReader(file, tree, place_of_node, warnings, chosen).read();
}

}  // namespace pinocchio
