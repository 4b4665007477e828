#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/exit_codes.h"
#include "app/options.h"
#include "hybrid/settings/scene_stats.h"
#include "pinocchio/progress.h"

namespace pinocchio::app {

// Loads scenes and builds their trees on a thread of its own, while the window lives on: one thing at a time.
class SceneLoader {
 public:
  ~SceneLoader() { cancel(); }
  // How far it is, in words; empty: nothing is being loaded.
  struct Progress {
    std::string phase;
    double seconds = 0.0;  // since it began
    double share = 0.0;    // of the work that is done, 0 to 1
  };
  // What a call of poll() found; mostly nothing.
  struct News {
    std::optional<Scene> scene;            // was read
    SceneStats stats;                      // its own
    Bounds interest;                       // what matters of it (framing.h)
    std::vector<std::string> warnings;     // what of its file the picture lacks
    Camera camera;                         // that the options ask for in it
    std::shared_ptr<const Tracer> tracer;  // its tree is built
    std::string error;                     // one line: it could not be loaded
    ExitCode code = kDone;                 // what the error would end a verb with
  };

  // Each begins; what was being loaded before is forgotten.
  void load(const DrawOptions& options);
  void build_tree(const Scene& scene, const Settings& settings);
  // Nothing is loaded any more; the work ends soon.
  void cancel();
  [[nodiscard]] News poll();
  [[nodiscard]] Progress progress() const;
  // Whether a thread, also a forgotten one, is at work.
  [[nodiscard]] bool busy() const { return threads_.use_count() > 1; }

 private:
  [[nodiscard]] static News read(const DrawOptions& options, pinocchio::Progress& progress);
  using Work = std::function<News(pinocchio::Progress&)>;
  void start(const std::string& phase, const std::string& source, Work work);

  std::string phase_, source_;
  double begin_s_ = 0.0;
  std::shared_ptr<pinocchio::Progress> progress_;  // the work's, too
  std::future<News> news_;
  std::shared_ptr<int> threads_ = std::make_shared<int>(0);  // each thread holds a reference
};

}  // namespace pinocchio::app
