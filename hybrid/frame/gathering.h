#pragma once

#include <optional>

#include "core/denoise/gathered_light.h"
#include "pinocchio/renderer.h"

namespace pinocchio {

// The sampled light of a stream of frames, filtered (Settings::denoise). Used by the thread that traces.
class Gathering {
 public:
  // Adds the frame's sample. `light` becomes the light that its picture shows for it (GatheredLight::add): of
  // the first samples it is their own, of the last of Settings::spp the filter's. Where each picture is
  // shown, and beyond spp, samples 1, 2, 4, 8 ... are filtered, and the others leave the mean as it is.
  // Another view starts again.
  void add(const FrameRequest& request, const GatheredLight::Layers& sample, Workers& workers,
           Image<glm::vec3>& light);
  // Frees the memory.
  void release();

 private:
  GatheredLight light_;
  std::optional<FrameRequest> of_;  // the newest sample
};

}  // namespace pinocchio
