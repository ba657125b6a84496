#include "light/picture/fog/fog_scatter.h"

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr float kDepths = 8.0f;  ///< of fog, beyond which nothing is seen
constexpr float kFarthest_m = 1000.0f;
constexpr float kGrowth = 200.0f;  ///< the last slice is about so many times as long as the first
constexpr float kHalved_rad = 5.0f * static_cast<float>(kRadPerDeg);  ///< where k is a half: see FogScatter
constexpr float kStep_rad = 0.1f;  ///< of what a slice is divided into, seen from the lamp

}  // namespace

FogSlices::FogSlices(const sky::Fog& fog) {
  const float last_m = std::min(kDepths / fog.per_m, kFarthest_m);
  for (std::size_t i = 0; i <= kCount; ++i)
    ends_[i] = last_m * std::expm1(std::log1p(kGrowth) * static_cast<float>(i) / kCount) / kGrowth;
}

float FogSlices::place(float distance_m) const {
  const float share = std::clamp(distance_m / last(), 0.0f, 1.0f);
  return std::log1p(kGrowth * share) / std::log1p(kGrowth) * kCount;
}

struct FogScatter::Line {
  Line(const FogScatter& of, const Eigen::Vector3f& towards)
      : start(of.eye_ + of.fog_.begins(towards.z()) * towards) {
    const Eigen::Vector3f way = of.beam_.position() - start;
    nearest_m = towards.dot(way);
    beside_m = std::max((way - nearest_m * towards).norm(), std::max(of.beam_.radius_m(), 1e-3f));
    angle_rad = std::atan2(beside_m, nearest_m);
    const LampBeam::Stretch lit = of.beam_.withinCone(start, towards);
    lit_from = angleAt(lit.from);
    lit_to = angleAt(lit.to);
  }
  /// From the lamp, at a right angle to the line or more.
  float angleAt(float distance_m) const { return std::atan((distance_m - nearest_m) / beside_m); }
  float distanceAt(float angle) const { return nearest_m + beside_m * std::tan(angle); }

  Eigen::Vector3f start;
  float nearest_m;         ///< from the start to where the line is nearest to the lamp; behind it below 0
  float beside_m;          ///< from there to the lamp
  float angle_rad;         ///< between the line and the lamp, at the start
  float lit_from, lit_to;  ///< angles of angleAt(): within the lamp's cone
};

FogScatter::FogScatter(const LampBeam& beam, const sky::Fog& fog, const Eigen::Vector3f& eye)
    : beam_(beam), fog_(fog), eye_(eye) {}

Eigen::Vector3f FogScatter::middle(const Eigen::Vector3f& towards, float from_m, float to_m) const {
  const Line line(*this, towards);
  float from = line.angleAt(from_m), to = line.angleAt(to_m);
  if (std::max(from, line.lit_from) < std::min(to, line.lit_to)) {
    from = std::max(from, line.lit_from);
    to = std::min(to, line.lit_to);
  }
  return line.start + line.distanceAt(0.5f * (from + to)) * towards;
}

void FogScatter::addAlong(const Eigen::Vector3f& towards, const FogSlices& slices, const LampOpen& open,
                          GlowProfile* profile) const {
  if (!std::isfinite(fog_.begins(towards.z()))) return;
  const Line line(*this, towards);
  const float per_m = fog_.per_m * std::max(1.0f / (1.0f + line.angle_rad / kHalved_rad), kLeastExtinction);
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  float end = line.angleAt(0.0f);
  for (std::size_t i = 0; i < FogSlices::kCount; ++i) {
    const float begin = end;
    end = line.angleAt(slices.end(i + 1));
    // Cut off sharply at the cone: what steps there would meet by chance jumps from one line to the next.
    const float from = std::max(begin, line.lit_from), to = std::min(end, line.lit_to);
    float of_slice = 0.0f;
    const bool seen = from < to && (open.passed[i] > 0.0f || open.last[i] > 0.0f);
    const int steps = seen ? 1 + static_cast<int>(std::ceil((to - from) / kStep_rad)) : 0;
    for (int k = 0; k < steps; ++k) {
      // By equal angles from the lamp its 1 / r² is met: ds = r² / D dθ.
      const float distance_m =
          line.distanceAt(from + (to - from) * (static_cast<float>(k) + 0.5f) / static_cast<float>(steps));
      const Eigen::Vector3f point = line.start + distance_m * towards;
      if (point.z() - eye_.z() > fog_.top_m) continue;
      const Eigen::Vector3f away = point - beam_.position();
      const float r = std::max(away.norm(), line.beside_m);
      of_slice += beam_.share(point) * sky::dropletPhase(-towards.dot(away) / r) *
                  std::exp(-per_m * (distance_m + r)) * r * r;
    }
    if (seen) {
      const Eigen::Array3f light = beam_.intensity() * (of_slice * fog_.per_m * (to - from) /
                                                        (static_cast<float>(steps) * line.beside_m));
      sum += light * open.passed[i];
      profile->last[i] += light * open.last[i];
    }
    profile->before[i + 1] += sum;
  }
}

}  // namespace sunlit::light
