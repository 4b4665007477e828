#include "app/window/applied_settings.h"

#include "core/parallel/workers.h"
#include "gl/context/context.h"
#include "hybrid/settings/resolve.h"

namespace pinocchio::app {

Expected<Settings> AppliedSettings::resolved(const Settings& wanted, const SceneStats& stats,
                                             bool keeps_mask) const {
  return resolve(wanted, stats,
                 {model_.wanted_size(), engine_.gl_info()->software, keeps_mask,
                  !model_.camera.camera().is_rasterisable()});
}

void AppliedSettings::update() {
  if (apply(model_.settings)) {
    model_.applied = model_.settings;
    lights_ = model_.scene.lights;
    return;
  }
  model_.settings = model_.applied;
  model_.scene.lights = lights_;
  recount_lights(model_.scene, model_.stats);
  (void)apply(model_.settings);
}

// False, and a message, where the scene cannot be drawn by the settings. Until there is a tree, the GPU draws
// alone.
bool AppliedSettings::apply(const ViewSettings& settings) {
  Expected<Settings> wanted =
      resolved(wanted_settings(settings), model_.stats, settings.buffer == Layer::mask);
  if (!wanted) {
    model_.messages.hint(wanted.error().message());
    return false;
  }
  source_.request_tree(*wanted);
  model_.threads = engine_.workers(wanted->threads).count();
  if (wanted->traces() && !model_.tracer) {
    Settings raster;
    apply_preset("mode", "raster", raster);
    wanted = resolved(raster, model_.stats, false);
  }
  if (model_.tracer) wanted = budget_.settings_for(*wanted);
  if (wanted->persistent != model_.drawn.persistent)
    screen_.set_picture(nullptr);                          // its buffers are replaced
  if (!(*wanted == model_.drawn)) model_.history.clear();  // the figures were of other settings
  model_.drawn = *wanted;
  return true;
}

}  // namespace pinocchio::app
