#include "hybrid/frame/gathering.h"

#include <bit>

#include "hybrid/frame/samples.h"

namespace pinocchio {

namespace {

GatheredLight::Picture picture_of(const FrameRequest& request, int samples) {
  if (samples == request.settings.spp) return GatheredLight::Picture::filtered;
  if (samples < request.settings.spp && !request.shows_samples) return GatheredLight::Picture::mean;
  return std::has_single_bit(static_cast<unsigned>(samples)) ? GatheredLight::Picture::filtered
                                                             : GatheredLight::Picture::kept;
}

}  // namespace

void Gathering::add(const FrameRequest& request, const GatheredLight::Layers& sample, Workers& workers,
                    Image<glm::vec3>& light) {
  const bool continues = of_ && same_view(*of_, request) && request.view.sample == light_.samples();
  if (!continues) light_.reset();
  of_ = request;
  const int count = light_.samples() + 1;
  light_.add(sample, picture_of(request, count), request.settings.isa, workers, light);
}

void Gathering::release() {
  light_.release();
  of_.reset();
}

}  // namespace pinocchio
