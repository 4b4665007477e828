#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "app/exit_codes.h"
#include "app/options.h"
#include "hybrid/needs.h"
#include "hybrid/prepared_scene.h"

namespace pinocchio::app {

// Loads a scene and builds its tree on a thread of its own, while the window lives on. The scene can be
// drawn by the GPU alone as soon as it is read; the tree comes later.
class SceneLoader {
 public:
  // How far it is, in words; empty: nothing is being loaded.
  struct Progress {
    std::string phase;
    double seconds = 0.0;  // since the phase began
  };
  // What a call of poll() found; mostly nothing.
  struct News {
    std::shared_ptr<PreparedScene> scene;  // read: without tree, with GPU buffers
    Needs needs;                           // its own
    Camera camera;                         // that the options ask for in it
    std::vector<Light> lights;             // as they were read: also those that reach nothing may cast
    std::shared_ptr<const Tracer> tracer;  // its tree is built
    std::string error;                     // one line: it could not be loaded
    ExitCode code = kDone;                 // what the error would end a verb with
  };

  // Begins; what was being loaded before is forgotten.
  void start(const DrawOptions& options);
  // What is being loaded is not wanted.
  void forget() { job_.reset(); }
  // On the thread of the GL context.
  [[nodiscard]] News poll();
  [[nodiscard]] Progress progress() const;
  // Whether a thread, also a forgotten one, is at work.
  [[nodiscard]] bool busy() const { return threads_ && threads_.use_count() > 1; }

 private:
  struct Job;
  std::shared_ptr<Job> job_;
  std::shared_ptr<int> threads_ = std::make_shared<int>(0);  // each thread holds a reference
};

}  // namespace pinocchio::app
