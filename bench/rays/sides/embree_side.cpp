#include "bench/rays/sides/embree_side.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <string>

#include "bench/one_ray/embree_ray.h"
#include "bench/rays/sides/measure.h"
#include "pinocchio/error.h"

namespace pinocchio::bench {
namespace {

// Embree's types and calls for packets of 8 and of 16.
struct Of8 {
  static constexpr std::size_t kSize = 8;
  using Rays = RTCRay8;
  using Hits = RTCRayHit8;
  static constexpr auto kIntersect = rtcIntersect8;
  static constexpr auto kOccluded = rtcOccluded8;
};
struct Of16 {
  static constexpr std::size_t kSize = 16;
  using Rays = RTCRay16;
  using Hits = RTCRayHit16;
  static constexpr auto kIntersect = rtcIntersect16;
  static constexpr auto kOccluded = rtcOccluded16;
};
static_assert(kChunk % Of16::kSize == 0);

bool count_bytes(void* total, ssize_t bytes, bool) {
  *static_cast<std::atomic<ssize_t>*>(total) += bytes;
  return true;
}

// Embree reports a blocked ray with a negative tfar.
Hit blocked_hit(float t_far) {
  return t_far < 0.0f ? Hit{0.0f, 0} : Hit{};
}

Hit closest_hit(unsigned geometry, unsigned triangle, float t_far) {
  return geometry == RTC_INVALID_GEOMETRY_ID ? Hit{} : Hit{t_far, triangle};
}

class Single final : public RayBackend {
 public:
  explicit Single(RTCScene scene) : scene_(scene) {}

  [[nodiscard]] std::string name() const override { return "embree 1"; }

  void load(const RaySet& set) override {
    query_ = set.query;
    closest_.clear();
    any_.clear();
    for (const Ray& ray : set.rays) {
      if (query_ == Query::any) {
        any_.push_back(to_embree(ray));
      } else {
        closest_.push_back({to_embree(ray), {}});
        closest_.back().hit.geomID = RTC_INVALID_GEOMETRY_ID;
      }
    }
  }

  void trace(std::size_t first, std::size_t count) override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = first; i < first + count; ++i) {
      if (query_ == Query::closest)
        rtcIntersect1(scene_, &context, &closest_[i]);
      else
        rtcOccluded1(scene_, &context, &any_[i]);
    }
  }

  [[nodiscard]] std::vector<Hit> hits() const override {
    std::vector<Hit> found;
    for (const RTCRayHit& r : closest_) found.push_back(closest_hit(r.hit.geomID, r.hit.primID, r.ray.tfar));
    for (const RTCRay& r : any_) found.push_back(blocked_hit(r.tfar));
    return found;
  }

 private:
  RTCScene scene_;
  Query query_ = Query::closest;
  std::vector<RTCRayHit> closest_;
  std::vector<RTCRay> any_;
};

template <class Rays>
void put(const Ray& ray, Rays& to, std::size_t lane) {
  to.org_x[lane] = ray.origin.x, to.org_y[lane] = ray.origin.y, to.org_z[lane] = ray.origin.z;
  to.dir_x[lane] = ray.direction.x, to.dir_y[lane] = ray.direction.y, to.dir_z[lane] = ray.direction.z;
  to.tfar[lane] = ray.t_max;
  to.mask[lane] = 0xffffffffu;
}

template <class Of>
class Packets final : public RayBackend {
 public:
  explicit Packets(RTCScene scene) : scene_(scene) {}

  [[nodiscard]] std::string name() const override { return "embree " + std::to_string(kPacket); }

  void load(const RaySet& set) override {
    query_ = set.query;
    count_ = set.rays.size();
    const std::size_t packets = (count_ + kPacket - 1) / kPacket;
    closest_.assign(query_ == Query::closest ? packets : 0, typename Of::Hits{});
    any_.assign(query_ == Query::any ? packets : 0, typename Of::Rays{});
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t packet = i / kPacket, lane = i % kPacket;
      put(set.rays[i], query_ == Query::closest ? closest_[packet].ray : any_[packet], lane);
      if (query_ == Query::closest) closest_[packet].hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  void trace(std::size_t first, std::size_t count) override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) int valid[kPacket];
    for (std::size_t i = first; i < first + count; i += kPacket) {
      for (std::size_t lane = 0; lane < kPacket; ++lane) valid[lane] = i + lane < first + count ? -1 : 0;
      if (query_ == Query::closest)
        Of::kIntersect(valid, scene_, &context, &closest_[i / kPacket]);
      else
        Of::kOccluded(valid, scene_, &context, &any_[i / kPacket]);
    }
  }

  [[nodiscard]] std::vector<Hit> hits() const override {
    std::vector<Hit> found;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t packet = i / kPacket, lane = i % kPacket;
      if (query_ == Query::any) {
        found.push_back(blocked_hit(any_[packet].tfar[lane]));
      } else {
        const auto& r = closest_[packet];
        found.push_back(closest_hit(r.hit.geomID[lane], r.hit.primID[lane], r.ray.tfar[lane]));
      }
    }
    return found;
  }

 private:
  static constexpr std::size_t kPacket = Of::kSize;
  RTCScene scene_;
  Query query_ = Query::closest;
  std::size_t count_ = 0;
  std::vector<typename Of::Hits> closest_;
  std::vector<typename Of::Rays> any_;
};

template <class Of>
void occluded_in(RTCScene scene, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) int valid[Of::kSize];
  typename Of::Rays packet{};
  for (std::size_t i = 0; i < rays.size(); i += Of::kSize) {
    const std::size_t count = std::min(Of::kSize, rays.size() - i);
    for (std::size_t lane = 0; lane < Of::kSize; ++lane) {
      valid[lane] = lane < count ? -1 : 0;
      packet.tnear[lane] = 0.0f;
      if (lane < count) put(rays[i + lane], packet, lane);
    }
    Of::kOccluded(valid, scene, &context, &packet);
    for (std::size_t lane = 0; lane < count; ++lane) blocked[i + lane] = packet.tfar[lane] < 0.0f ? 1 : 0;
  }
}

}  // namespace

struct EmbreeSide::Held {
  std::atomic<ssize_t> bytes{0};
  std::vector<glm::vec3> positions;  // the scene's and one more: Embree reads 16 bytes at the last position
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Held() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  // The scene with its geometry, before the build.
  void attach(const Mesh& from, bool robust) {
    if (scene) rtcReleaseScene(scene);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(mesh, RTC_BUILD_QUALITY_HIGH);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(glm::vec3), positions.size() - 1);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, from.triangles.data(), 0,
                               sizeof(glm::uvec3), from.triangles.size());
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
  }
};

EmbreeSide::EmbreeSide(const Mesh& mesh, bool robust, int threads, int repeat, Isa widest)
    : held_(std::make_unique<Held>()), has_avx512_(widest == Isa::avx512) {
  const std::string max_isa(widest == Isa::scalar || widest == Isa::sse4 ? "sse4.2" : isa_name(widest));
  held_->positions = mesh.positions;
  held_->positions.emplace_back(0.0f);
  held_->device = rtcNewDevice(("threads=" + std::to_string(threads) + ",max_isa=" + max_isa).c_str());
  if (!held_->device) throw EnvironmentError("Embree cannot be started on this machine");
  rtcSetDeviceMemoryMonitorFunction(held_->device, count_bytes, &held_->bytes);
  cost_.name = "embree";
  cost_.seconds = median_seconds(
      repeat, [&] { held_->attach(mesh, robust); }, [&] { rtcCommitScene(held_->scene); });
  cost_.bytes = static_cast<std::size_t>(held_->bytes.load());
  if (rtcGetDeviceError(held_->device) != RTC_ERROR_NONE)
    throw EnvironmentError("Embree could not build the scene");
}

EmbreeSide::~EmbreeSide() = default;

std::unique_ptr<RayBackend> EmbreeSide::single() const {
  return std::make_unique<Single>(held_->scene);
}
std::unique_ptr<RayBackend> EmbreeSide::packets() const {
  if (has_avx512_) return std::make_unique<Packets<Of16>>(held_->scene);
  return std::make_unique<Packets<Of8>>(held_->scene);
}

void EmbreeSide::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  has_avx512_ ? occluded_in<Of16>(held_->scene, rays, blocked)
              : occluded_in<Of8>(held_->scene, rays, blocked);
}

const char* embree_version() {
  return RTC_VERSION_STRING;
}

}  // namespace pinocchio::bench
