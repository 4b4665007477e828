#include "app/window/settings.h"

#include <algorithm>

namespace pinocchio::app {
namespace {

constexpr float kScaleStep = 1.25f, kExposureStep = 0.5f;

// The next of an enumeration's first `count` values.
template <class Enum>
Enum next(Enum value, int count) {
  return static_cast<Enum>((static_cast<int>(value) + 1) % count);
}

void toggle(bool& setting) {
  setting = !setting;
}

// Steps of the scale meet whole size exactly.
float near_one(float scale) {
  return scale > 0.95f && scale < 1.05f ? 1.0f : scale;
}

}  // namespace

void change_setting(Action action, ViewSettings& s) {
  switch (action) {
    case Action::next_mode:
      s.mode = next(s.mode, 3);
      break;
    case Action::next_design:
      s.design = s.design == 1 ? 2 : 1;
      break;
    case Action::next_exchange:
      s.exchange = next(s.exchange, s.design == 2 ? 2 : 3);  // design 2 has nothing to reproject
      break;
    case Action::next_plan:
      s.plan = next(s.plan, s.has_plan_file ? 3 : 2);
      break;
    case Action::shadows:
      toggle(s.shadows);
      break;
    case Action::reflections:
      toggle(s.reflections);
      break;
    case Action::deeper:
      ++s.depth;
      break;
    case Action::shallower:
      --s.depth;
      break;
    case Action::brighter:
      s.exposure_ev += kExposureStep;
      break;
    case Action::darker:
      s.exposure_ev -= kExposureStep;
      break;
    case Action::finer:
      s.scale = near_one(s.scale * kScaleStep);
      break;
    case Action::coarser:
      s.scale = near_one(s.scale / kScaleStep);
      break;
    case Action::accumulate:
      toggle(s.accumulate);
      break;
    case Action::split:
      s.split = next(s.split, 3);
      break;
    case Action::vsync:
      toggle(s.vsync);
      break;
    case Action::overlay:
      toggle(s.overlay);
      break;
    case Action::help:
      toggle(s.help);
      break;
    default:
      break;
  }
}

void next_buffer(ViewSettings& s, int mask_slots) {
  if (s.buffer == BufferView::mask && s.mask_slot + 1 < mask_slots) {
    ++s.mask_slot;
    return;
  }
  s.mask_slot = 0;
  s.buffer = next(s.buffer, static_cast<int>(kBufferViewNames.size()));
}

PlanRequest plan_request(const ViewSettings& settings) {
  PlanRequest request;
  request.mode = settings.mode;
  request.design = settings.design;
  request.depth = settings.reflections ? settings.depth : 0;
  request.slides = settings.plan == PlanSource::slides;
  request.keeps_mask = settings.buffer == BufferView::mask;
  request.reprojects = settings.exchange == Exchange::reproject;
  return request;
}

ViewSettings possible(ViewSettings settings) {
  if (settings.design == 2 && settings.exchange == Exchange::reproject)
    settings.exchange = Exchange::pipelined;
  settings.depth = std::clamp(settings.depth, 0, kMostDepth);
  settings.scale = std::clamp(settings.scale, kLeastScale, kMostScale);
  settings.mask_slot = std::max(settings.mask_slot, 0);
  settings.split_at = std::clamp(settings.split_at, 0.05f, 0.95f);
  settings.exposure_ev = std::clamp(settings.exposure_ev, -kMostExposure, kMostExposure);
  return settings;
}

}  // namespace pinocchio::app
