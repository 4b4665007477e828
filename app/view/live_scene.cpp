#include "app/view/live_scene.h"

#include <algorithm>

namespace pinocchio::app {

void LiveScene::set_scene(std::shared_ptr<PreparedScene> scene, const Needs& needs) {
  shown_ = std::move(scene);
  all_ = {shown_};
  needs_ = needs;
}

void LiveScene::set_tracer(const std::shared_ptr<const Tracer>& tracer) {
  for (const std::shared_ptr<PreparedScene>& scene : all_) scene->tracer = tracer;
}

void LiveScene::set_lights(const std::vector<Light>& lights, bool casting) {
  std::vector<Light> wanted = lights;
  if (!casting)
    for (Light& light : wanted) light.casts_shadow = false;
  // One reference is the list's own.
  const auto unused = std::find_if(all_.begin(), all_.end(), [this](const std::shared_ptr<PreparedScene>& s) {
    return s != shown_ && s.use_count() == 1;
  });
  if (unused != all_.end()) {
    (*unused)->relight(std::move(wanted));
    shown_ = *unused;
  } else {
    shown_ = std::make_shared<PreparedScene>(shown_, std::move(wanted));
    all_.push_back(shown_);
  }
  recount_lights(shown_->scene, needs_);
}

}  // namespace pinocchio::app
