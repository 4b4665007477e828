#include "app/view/painter.h"

#include <algorithm>
#include <chrono>

#include "hybrid/raytrace.h"

namespace pinocchio::app {

Painter::Painter(Workers& workers, std::shared_ptr<Programs> programs, Exchange exchange, Sinks sinks)
    : workers_(workers),
      sinks_(std::move(sinks)),
      loop_(workers, std::move(programs), exchange, gl::Mapping::each_time,
            {[this](Flight& frame) {
               sinks_.painted({frame.picture.target.color(), frame.request, frame.record, &frame});
             },
             sinks_.record}) {}

Painter::~Painter() {
  if (raytraced_.valid()) raytraced_.wait();
}

void Painter::draw(const FrameRequest& request) {
  deliver_raytraced();
  if (request.plan.mode != Mode::raytrace) return loop_.submit(request);
  loop_.drain();
  if (raytraced_.valid() || last_raytraced_ == request) return;
  raytraced_ = std::async(std::launch::async, [this, request] {
    Raytraced result{request, {}, {}};
    result.record = raytrace(request, workers_, result.picture);
    return result;
  });
}

void Painter::drain() {
  loop_.drain();
  if (raytraced_.valid()) raytraced_.wait();
  deliver_raytraced();
}

void Painter::deliver_raytraced() {
  if (!raytraced_.valid() || raytraced_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  Raytraced result = raytraced_.get();
  result.record.number = next_number_++;
  const Image<glm::vec4>& color = result.picture.color;
  fit(texture_, color.size(), gl::kRgba32F);
  {
    const StageTimer timer(result.record, Stage::upload);
    const std::span<std::byte> bytes = upload_.open(texture_.bytes());
    std::ranges::copy(std::as_bytes(color.pixels()), bytes.begin());
    upload_.send(texture_);
  }
  last_raytraced_ = result.request;
  sinks_.painted({texture_, result.request, result.record, nullptr});
  result.record.frame.end_s = std::max(result.record.frame.end_s, result.record[Stage::present].end_s);
  sinks_.record(result.record);
}

}  // namespace pinocchio::app
