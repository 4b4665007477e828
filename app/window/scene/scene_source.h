#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/window/model/model.h"
#include "app/window/scene/file_watch.h"

namespace pinocchio::app {

// Where the window's scene comes from: loads scenes and builds their trees in the background, and watches
// their files.
class SceneSource {
 public:
  // watch: a scene is loaded again when its files change.
  SceneSource(Model& model, const DrawOptions& options, bool watch);

  // What the scene in the window was loaded by.
  [[nodiscard]] const DrawOptions& options() const { return options_; }
  // Begins to load a file. Until it is read, the scene before stays.
  void open(const std::string& file);
  // Begins to load a picture of light from all directions.
  void open_environment(const std::string& file);
  void reload() { load(options_); }
  // Reads the file again, with another of its axes pointing up.
  void turn_up(UpAxis axis);
  // Reads the file again, with one of its variants of materials. Empty: its usual ones.
  void choose_variant(const std::string& name);
  // Begins to load the file that was refused for its memory, without a limit.
  void open_unlimited();
  void cancel();
  // What the background has finished. An error becomes a message.
  [[nodiscard]] SceneLoader::News poll();
  // The verb's exit code where no scene could be opened.
  [[nodiscard]] ExitCode code() const { return model_.has_scene() ? kDone : code_; }
  [[nodiscard]] bool is_busy() const { return loader_.busy(); }

  // Keeps the scene that was polled until it may be shown, or something else is loaded.
  void keep(SceneLoader::News news) { kept_ = std::move(news); }
  [[nodiscard]] bool has_kept() const { return kept_.has_value(); }
  [[nodiscard]] SceneLoader::News take_kept() { return std::move(*std::exchange(kept_, std::nullopt)); }
  // The scene that was polled is in the window now, or is not going to be.
  void accept(const Scene& scene);
  void reject() {
    pending_.reset();
    kept_.reset();
  }
  // Whether a file of the scene has changed.
  [[nodiscard]] bool has_changed(double now_s) { return watch_ && watch_->changed(now_s); }

  // Begins to build the tree that these settings trace in, where there is none. Until it is built, frames
  // trace in the old tree.
  void request_tree(const Settings& settings);
  // The triangles are others now.
  void forget_tree() { tree_settings_.reset(); }
  [[nodiscard]] Settings tree_settings() const { return tree_settings_.value_or(model_.drawn); }

 private:
  void load(const DrawOptions& options);

  Model& model_;
  SceneLoader loader_;
  DrawOptions options_;
  std::optional<DrawOptions> pending_;  // of the scene that is being read, or is kept
  std::optional<SceneLoader::News> kept_;
  std::optional<DrawOptions> refused_;     // for its memory
  std::optional<Settings> tree_settings_;  // of the tree that is built, or being built
  ExitCode code_ = kDone;
  bool watches_;
  std::optional<FileWatch> watch_;
};

}  // namespace pinocchio::app
