#include "gl/open.h"

#include <algorithm>

#include "gl/egl.h"
#include "gl/error.h"
#include "gl/glfw.h"
#include "gl/osmesa.h"
#include "gl/probe.h"

namespace pinocchio::gl {
namespace {

std::vector<Candidate> all_candidates() {
  std::vector<Candidate> candidates = egl_candidates();
  candidates.push_back(osmesa_candidate());
  candidates.push_back(glfw_candidate());
  return candidates;
}

bool wanted(const Candidate& candidate, const ContextRequest& request) {
  // A window of the display is taken only where it is asked for.
  if (request.backend == "auto" ? candidate.backend == "glfw" : candidate.backend != request.backend)
    return false;
  if (request.device.empty()) return true;
  if (request.device == "software") return candidate.software;
  return candidate.device && std::to_string(*candidate.device) == request.device;
}

// Throws Error where it cannot be opened or its driver does not do what it claims.
std::unique_ptr<Context> open_and_probe(const Candidate& candidate, bool debug) {
  std::unique_ptr<Context> context = candidate.open(debug);
  probe(context->info());
  return context;
}

}  // namespace

std::unique_ptr<Context> open_context(const ContextRequest& request) {
  std::string failures;
  for (const Candidate& candidate : all_candidates()) {
    if (!wanted(candidate, request)) continue;
    try {
      return open_and_probe(candidate, request.debug);
    } catch (const Error& error) {
      failures += (failures.empty() ? "" : "; ") + candidate.what + ": " + error.what();
    }
  }
  const std::string asked = (request.backend == "auto" ? "" : " --backend " + request.backend) +
                            (request.device.empty() ? "" : " --device " + request.device);
  throw NoContextError("no OpenGL context" + (asked.empty() ? asked : " for" + asked) + ": " +
                       (failures.empty() ? "no such device" : failures) +
                       "; 'pinocchio info --system' lists what was tried, --mode raytrace needs none");
}

bool may_be_hardware(const ContextRequest& request) {
  std::vector<Candidate> ways = all_candidates();
  std::erase_if(ways, [&](const Candidate& way) { return !wanted(way, request); });
  const bool any_listed =
      std::ranges::any_of(ways, [](const Candidate& way) { return way.device.has_value(); });
  // Where devices are listed, those ways that name none lead to one of them.
  return std::ranges::any_of(ways, [&](const Candidate& way) {
    return !way.software && (way.device || !any_listed || way.backend == "glfw");
  });
}

std::vector<Attempt> try_all_contexts() {
  std::vector<Attempt> attempts;
  for (const Candidate& candidate : all_candidates()) {
    Attempt attempt{candidate.what, "", {}};
    try {
      attempt.info = open_and_probe(candidate, false)->info();
    } catch (const Error& error) {
      attempt.failure = error.what();
    }
    attempts.push_back(std::move(attempt));
  }
  return attempts;
}

}  // namespace pinocchio::gl
