#include "evaluate/run/one_place.h"

#include <cstdio>

#include "sunlit/quantity/angle.h"

namespace sunlit::evaluate {

bool OnePlace::isBroken(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_optical) {
  const auto of_image = first_.find(stamp_ns);
  const bool has_image = of_image != first_.end();
  const Eigen::Isometry3d* first = waiting_.find(stamp_ns);
  if (has_image && of_image->second) first = &*of_image->second;
  if (first == nullptr) {
    if (has_image) of_image->second = map_from_optical;
    if (!has_image) waiting_.add(stamp_ns, map_from_optical);
    return false;
  }
  if (faults_.count(stamp_ns) != 0) return false;
  const double metres = (map_from_optical.translation() - first->translation()).norm();
  const Eigen::Matrix3d turned = first->linear().transpose() * map_from_optical.linear();
  const double degrees = Eigen::AngleAxisd(turned).angle() / kRadPerDeg;
  if (metres <= kSamePlace_m && degrees <= kSamePlace_deg) return false;
  char text[128];
  std::snprintf(text, sizeof text,
                "two poses of this stamp are %.3g m and %.3g deg apart: are these two recordings?", metres,
                degrees);
  faults_.emplace(stamp_ns, text);
  return true;
}

void OnePlace::noteImage(std::int64_t stamp_ns) {
  const auto [found, is_first] = first_.emplace(stamp_ns, std::nullopt);
  if (is_first) found->second = waiting_.take(stamp_ns);
}

std::string OnePlace::fault(std::int64_t stamp_ns) const {
  const auto found = faults_.find(stamp_ns);
  return found == faults_.end() ? "" : found->second;
}

}  // namespace sunlit::evaluate
