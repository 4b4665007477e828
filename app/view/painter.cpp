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
               sinks_.painted({frame.picture.target.color(), frame.request, frame.record, &frame, nullptr});
             },
             sinks_.record}) {}

Painter::~Painter() {
  if (raytraced_.valid()) raytraced_.wait();
}

bool Painter::draw(const FrameRequest& request) {
  deliver_raytraced();
  if (request.plan.mode != Mode::raytrace) {
    last_.reset();
    loop_.submit(request);
    return true;
  }
  loop_.drain();
  if (raytraced_.valid()) return false;
  if (last_ && last_->request == request) {  // once more
    FrameRecord record;
    record.number = next_number_++;
    record.frame.begin_s = now_s();
    sinks_.painted({texture_, last_->request, record, nullptr, &last_->picture});
    record.frame.end_s = now_s();
    sinks_.record(record);
    return true;
  }
  raytraced_ = std::async(std::launch::async, [this, request] {
    Raytraced result{request, {}, {}};
    result.record = raytrace(request, workers_, result.picture);
    return result;
  });
  return true;
}

void Painter::drain() {
  loop_.drain();
  if (raytraced_.valid()) raytraced_.wait();
  deliver_raytraced();
}

void Painter::deliver_raytraced() {
  if (!raytraced_.valid() || raytraced_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  last_ = raytraced_.get();
  FrameRecord& record = last_->record;
  record.number = next_number_++;
  const Image<glm::vec4>& color = last_->picture.color;
  fit(texture_, color.size(), gl::kRgba32F);
  {
    const StageTimer timer(record, Stage::upload);
    const std::span<std::byte> bytes = upload_.open(texture_.bytes());
    std::ranges::copy(std::as_bytes(color.pixels()), bytes.begin());
    upload_.send(texture_);
  }
  sinks_.painted({texture_, last_->request, record, nullptr, &last_->picture});
  record.frame.end_s = std::max(record.frame.end_s, record[Stage::present].end_s);
  sinks_.record(record);
}

}  // namespace pinocchio::app
