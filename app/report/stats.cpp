#include "app/report/stats.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/system_info.h"
#include "hybrid/settings/json.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

// The mean of a count over the frames, as a whole number where it is one.
template <class Count>
nlohmann::json per_frame(std::span<const FrameRecord> records, Count count) {
  std::uint64_t sum = 0;
  for (const FrameRecord& record : records) sum += count(record);
  if (records.empty()) return 0;
  if (sum % records.size() == 0) return sum / records.size();
  return 1.0 * sum / records.size();
}

template <class Milliseconds>
nlohmann::json spread(std::span<const FrameRecord> records, Milliseconds ms) {
  std::vector<double> values;
  for (const FrameRecord& record : records) values.push_back(ms(record));
  return {{"ms", percentiles(std::move(values))}};
}

nlohmann::json bytes_json(std::span<const FrameRecord> records) {
  nlohmann::json buffers;
  for (std::size_t i = 0; i < kChannelNames.size(); ++i)
    buffers[std::string(kChannelNames[i])] =
        per_frame(records, [i](const FrameRecord& r) { return r.bytes[i]; });
  return {{"gpu_to_cpu", per_frame(records, [](const FrameRecord& r) { return r.bytes_to_cpu(); })},
          {"cpu_to_gpu", per_frame(records, [](const FrameRecord& r) { return r.bytes_to_gpu(); })},
          {"buffers", buffers}};
}

nlohmann::json rays_json(std::span<const FrameRecord> records) {
  nlohmann::json json;
  for (const RayKind& kind : kRayKinds)
    json[std::string(kind.name)] =
        per_frame(records, [&kind](const FrameRecord& r) { return r.rays.*kind.count; });
  return json;
}

// From the end of the first frame on: before it, pipelined frames have not begun to overlap.
double frames_per_second(std::span<const FrameRecord> records) {
  if (records.empty()) return 0.0;
  const FrameRecord &first = records.front(), &last = records.back();
  const bool alone = records.size() == 1;
  const double seconds = last.frame.end_s - (alone ? first.frame.begin_s : first.frame.end_s);
  return seconds > 0.0 ? (alone ? 1.0 : as_double(records.size() - 1)) / seconds : 0.0;
}

// From one delivered picture to the next, milliseconds; of a single frame, its own time.
std::vector<double> times_of_frames(std::span<const FrameRecord> records) {
  if (records.size() == 1) return {records.front().frame.ms()};
  std::vector<double> times;
  for (std::size_t i = 1; i < records.size(); ++i)
    times.push_back(1e3 * (records[i].frame.end_s - records[i - 1].frame.end_s));
  return times;
}

}  // namespace

nlohmann::json percentiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto rank = [&](double share) {
    if (values.empty()) return 0.0;
    const double place = std::ceil(share * values.size()) - 1.0;
    return values[std::size_t(std::max(place, 0.0))];
  };
  return {{"p50", rank(0.50)}, {"p95", rank(0.95)}, {"p99", rank(0.99)}};
}

nlohmann::json system_json(const gl::ContextInfo* context, Isa used) {
  const SystemInfo system = system_info();
  nlohmann::json levels = nlohmann::json::array();
  for (const Isa isa : supported_isas()) levels.push_back(isa_name(isa));
  nlohmann::json json{{"cpu", system.cpu},
                      {"cores", system.cores},
                      {"simd", isa_name(used)},
                      {"simd_levels", levels},
                      {"pinocchio", version()}};
  if (context)
    json["gl"] = {{"backend", context->backend}, {"device", context->device},
                  {"vendor", context->vendor},   {"renderer", context->renderer},
                  {"version", context->version}, {"kind", context->software ? "software" : "hardware"}};
  return json;
}

nlohmann::json figures(std::span<const FrameRecord> records, const Settings& settings, const Scene& scene,
                       glm::ivec2 size, const gl::ContextInfo* context) {
  // Reprojected, a frame is traced while the next one is drawn: the last one is not.
  const bool last_is_traced = settings.exchange != Exchange::reproject || records.size() < 2;
  const std::span<const FrameRecord> traced = records.first(records.size() - (last_is_traced ? 0 : 1));
  nlohmann::json stages;
  for (std::size_t i = 0; i < kStageNames.size(); ++i)
    stages[std::string(kStageNames[i])] =
        spread(records, [i](const FrameRecord& r) { return r.stages[i].ms(); });
  int latency_frames = 0;
  for (const FrameRecord& record : records) latency_frames = std::max(latency_frames, record.latency_frames);
  nlohmann::json latency = spread(records, [](const FrameRecord& r) { return r.frame.ms(); });
  latency["frames"] = latency_frames;
  return {{"frames", records.size()},
          {"size", {size.x, size.y}},
          {"bytes", bytes_json(traced)},
          {"latency", latency},
          {"frame", {{"ms", percentiles(times_of_frames(records))}}},
          {"stages", stages},
          {"rays", rays_json(traced)},
          {"fps", frames_per_second(records)},
          {"memory", {{"peak_bytes", peak_memory_bytes()}}},
          {"plan", to_json(settings)},
          {"scene",
           {{"file", scene.source},
            {"triangles", scene.mesh->triangles.size()},
            {"materials", scene.mesh->materials.size()},
            {"lights", scene.lights.size()}}},
          {"system", system_json(context, settings.isa)}};
}

}  // namespace pinocchio::app
