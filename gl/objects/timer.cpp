#include "gl/objects/timer.h"

#include <chrono>
#include <limits>

namespace pinocchio::gl {
namespace {

void stamp(Query& query) {
  if (!query) {
    GLuint name = 0;
    glGenQueries(1, &name);
    query = Query(name);
  }
  glQueryCounter(query.name(), GL_TIMESTAMP);
}

}  // namespace

double steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void GpuClock::calibrate() {
  constexpr int kTries = 4;
  double tightest_s = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTries; ++i) {
    GLint64 gpu_ns = 0;
    const double before_s = steady_now_s();
    glGetInteger64v(GL_TIMESTAMP, &gpu_ns);
    const double after_s = steady_now_s();
    if (after_s - before_s >= tightest_s) continue;
    tightest_s = after_s - before_s;
    offset_s_ = 0.5 * (before_s + after_s) - double(gpu_ns) * 1e-9;
  }
}

void GpuTimer::begin() {
  stamp(queries_[0]);
}
void GpuTimer::end() {
  stamp(queries_[1]);
}

GpuSpan GpuTimer::span(const GpuClock& clock) const {
  GLuint64 begin_ns = 0, end_ns = 0;
  glGetQueryObjectui64v(queries_[0].name(), GL_QUERY_RESULT, &begin_ns);
  glGetQueryObjectui64v(queries_[1].name(), GL_QUERY_RESULT, &end_ns);
  return {clock.to_cpu_s(begin_ns), clock.to_cpu_s(end_ns)};
}

}  // namespace pinocchio::gl
