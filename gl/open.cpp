#include "gl/open.h"

#include <algorithm>
#include <functional>

#include "gl/apart.h"
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

namespace {

using Say = std::function<void(const std::string&)>;

// Says the candidate's name, why it fails, or "" and what it is; nothing where there is no such one.
void try_candidate(std::size_t i, const Say& say) {
  const std::vector<Candidate> candidates = all_candidates();
  if (i >= candidates.size()) return;
  say(candidates[i].what);
  try {
    const std::unique_ptr<Context> context = open_and_probe(candidates[i], false);
    const ContextInfo& info = context->info();
    for (const std::string& text :
         {std::string(), info.backend, info.device, info.vendor, info.renderer, info.version,
          std::to_string(info.major), std::to_string(info.minor), std::string(info.software ? "1" : "0")})
      say(text);
  } catch (const Error& error) {
    say(error.what());
  }
}

Attempt attempt_of(const Apart& apart) {
  const std::vector<std::string>& said = apart.said;
  Attempt attempt{said.empty() ? "OpenGL's libraries" : said[0], apart.failure, {}};
  if (!attempt.failure.empty()) return attempt;
  attempt.failure = said.size() > 1 ? said[1] : "it says nothing";
  if (attempt.failure.empty())
    attempt.info = {said.at(2),
                    said.at(3),
                    said.at(4),
                    said.at(5),
                    said.at(6),
                    std::stoi(said.at(7)),
                    std::stoi(said.at(8)),
                    said.at(9) == "1"};
  return attempt;
}

}  // namespace

std::vector<Attempt> try_all_contexts() {
  std::vector<Attempt> attempts;
  for (std::size_t i = 0;; ++i) {
    const Apart apart = try_apart([i](const Say& say) { try_candidate(i, say); });
    if (!apart.said.empty() || !apart.failure.empty()) attempts.push_back(attempt_of(apart));
    if (apart.said.empty()) return attempts;  // there is no further one, or not even a list of them
  }
}

}  // namespace pinocchio::gl
