#include "sunlit/evaluate/same_place.h"

#include <cstdio>

#include "sunlit/quantity/angle.h"

namespace sunlit::evaluate {

std::string twoPlaces(const Eigen::Isometry3d& first, const Eigen::Isometry3d& second) {
  const double metres = (second.translation() - first.translation()).norm();
  const Eigen::Matrix3d turned = first.linear().transpose() * second.linear();
  const double degrees = Eigen::AngleAxisd(turned).angle() / kRadPerDeg;
  if (metres <= kSamePlace_m && degrees <= kSamePlace_deg) return "";
  char text[128];
  std::snprintf(text, sizeof text,
                "two poses of this stamp are %.3g m and %.3g deg apart: are these two recordings?", metres,
                degrees);
  return text;
}

}  // namespace sunlit::evaluate
