#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/errors.h"
#include "app/cli/options.h"
#include "hybrid/settings/scene_stats.h"
#include "pinocchio/progress.h"

namespace pinocchio::app {

// Loads scenes and builds their trees on a thread of its own, one thing at a time.
class SceneLoader {
 public:
  ~SceneLoader() { cancel(); }
  // phase: in words. Empty: nothing is being loaded.
  struct Progress {
    std::string phase;
    double seconds = 0.0;  // since it began
    double share = 0.0;    // of the work that is done, 0 to 1
  };
  // What was finished since the last poll(); mostly nothing.
  struct News {
    std::optional<Scene> scene;
    SceneStats stats;                                // of the scene
    Bounds interest;                                 // bounds_of_interest (framing.h)
    std::vector<std::string> warnings;               // what is ignored of its file
    Camera camera;                                   // by the options
    std::vector<std::string> extensions;             // of glTF, that its file uses
    std::shared_ptr<const Tracer> tracer;            // a tree was built
    std::shared_ptr<const Environment> environment;  // was read
    std::string error;                               // one line: the scene could not be loaded
    ExitCode code = kDone;                           // of the error
  };

  // Each begins in the background; earlier work is dropped.
  void load(const DrawOptions& options);
  void load_environment(const std::string& file, std::uint64_t limit_bytes);
  void build_tree(const Scene& scene, const Settings& settings);
  // Drops the work, which ends soon.
  void cancel();
  [[nodiscard]] News poll();
  [[nodiscard]] Progress progress() const;
  // Whether a thread is at work, also one whose work was dropped.
  [[nodiscard]] bool busy() const { return threads_.use_count() > 1; }

 private:
  [[nodiscard]] static News read(const DrawOptions& options, pinocchio::Progress& progress);
  using Work = std::function<News(pinocchio::Progress&)>;
  void start(const std::string& phase, const std::string& source, Work work);

  std::string phase_, source_;
  double begin_s_ = 0.0;
  std::shared_ptr<pinocchio::Progress> progress_;  // shared with the thread
  std::future<News> news_;
  std::shared_ptr<int> threads_ = std::make_shared<int>(0);  // each thread holds a reference
};

}  // namespace pinocchio::app
