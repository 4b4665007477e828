#include "gl/open/open.h"

#include <algorithm>

#include "gl/context/error.h"
#include "gl/open/apart.h"
#include "gl/open/egl.h"
#include "gl/open/glfw.h"
#include "gl/open/osmesa.h"
#include "gl/open/probe.h"

namespace pinocchio::gl {
namespace {

std::vector<Candidate> all_candidates() {
  std::vector<Candidate> candidates = egl_candidates();
  candidates.push_back(osmesa_candidate());
  candidates.push_back(glfw_candidate());
  return candidates;
}

bool wanted(const Candidate& candidate, const ContextRequest& request) {
  // A window of the display is used only on request.
  if (request.backend == "auto" ? candidate.backend == "glfw" : candidate.backend != request.backend)
    return false;
  if (request.device.empty()) return true;
  if (request.device == "software") return candidate.software;
  return candidate.device && std::to_string(*candidate.device) == request.device;
}

// Throws Error where the context cannot be opened or its driver fails the probe.
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
  // Where devices are listed, the ways without a device lead to one of them.
  return std::ranges::any_of(ways, [&](const Candidate& way) {
    return !way.software && (way.device || !any_listed || way.backend == "glfw");
  });
}

namespace {

// Reports the candidate's name, then its failure, or "" and the context's info. Reports nothing if there is
// no candidate i.
void try_candidate(std::size_t i, const Report& report) {
  const std::vector<Candidate> candidates = all_candidates();
  if (i >= candidates.size()) return;
  report(candidates[i].what);
  try {
    const std::unique_ptr<Context> context = open_and_probe(candidates[i], false);
    const ContextInfo& info = context->info();
    for (const std::string& text :
         {std::string(), info.backend, info.device, info.vendor, info.renderer, info.version,
          std::to_string(info.major), std::to_string(info.minor), std::string(info.software ? "1" : "0")})
      report(text);
  } catch (const Error& error) {
    report(error.what());
  }
}

Attempt attempt_of(const Apart& apart) {
  const std::vector<std::string>& texts = apart.reports;
  Attempt attempt{texts.empty() ? "OpenGL's libraries" : texts[0], apart.failure, {}};
  if (!attempt.failure.empty()) return attempt;
  attempt.failure = texts.size() > 1 ? texts[1] : "it reports nothing";
  if (attempt.failure.empty())
    attempt.info = {texts.at(2),
                    texts.at(3),
                    texts.at(4),
                    texts.at(5),
                    texts.at(6),
                    std::stoi(texts.at(7)),
                    std::stoi(texts.at(8)),
                    texts.at(9) == "1"};
  return attempt;
}

}  // namespace

std::vector<Attempt> try_all_contexts() {
  std::vector<Attempt> attempts;
  for (std::size_t i = 0;; ++i) {
    const Apart apart = try_apart([i](const Report& report) { try_candidate(i, report); });
    if (!apart.reports.empty() || !apart.failure.empty()) attempts.push_back(attempt_of(apart));
    if (apart.reports.empty()) return attempts;  // no more candidates, or listing them failed
  }
}

}  // namespace pinocchio::gl
