#include "evaluate/run/one_place.h"

#include <cstdio>

#include "sunlit/quantity/angle.h"

namespace sunlit::evaluate {

bool OnePlace::isBroken(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_optical) {
  const auto [found, is_first] = first_.emplace(stamp_ns, map_from_optical);
  if (is_first || faults_.count(stamp_ns) != 0) return false;
  const Eigen::Isometry3d& first = found->second;
  const double metres = (map_from_optical.translation() - first.translation()).norm();
  const Eigen::Matrix3d turned = first.linear().transpose() * map_from_optical.linear();
  const double degrees = Eigen::AngleAxisd(turned).angle() / kRadPerDeg;
  if (metres <= kSamePlace_m && degrees <= kSamePlace_deg) return false;
  char text[128];
  std::snprintf(text, sizeof text,
                "two poses of this stamp are %.3g m and %.3g deg apart: are these two recordings?", metres,
                degrees);
  faults_.emplace(stamp_ns, text);
  return true;
}

std::string OnePlace::fault(std::int64_t stamp_ns) const {
  const auto found = faults_.find(stamp_ns);
  return found == faults_.end() ? "" : found->second;
}

}  // namespace sunlit::evaluate
