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

std::int64_t ns_between(GLuint64 from, GLuint64 to, int bits) {
  const int unused = bits > 0 && bits < 64 ? 64 - bits : 0;
  return static_cast<std::int64_t>((to - from) << unused) >> unused;
}

bool GpuClock::is_old() const {
  constexpr double kOld_s = 10.0;
  return steady_now_s() - cpu_s_ > kOld_s;
}

void GpuClock::calibrate() {
  constexpr int kTries = 4;
  GLint bits = 0;
  glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  bits_ = bits;
  double tightest_s = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTries; ++i) {
    GLint64 gpu_ns = 0;
    const double before_s = steady_now_s();
    glGetInteger64v(GL_TIMESTAMP, &gpu_ns);
    const double after_s = steady_now_s();
    if (after_s - before_s >= tightest_s) continue;
    tightest_s = after_s - before_s;
    gpu_ns_ = static_cast<GLuint64>(gpu_ns);
    cpu_s_ = 0.5 * (before_s + after_s);
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
