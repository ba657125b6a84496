#include "evaluate/run/one_place.h"

#include <cmath>

#include "sunlit/evaluate/same_place.h"
#include "sunlit/quantity/range.h"

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
  const std::string apart = twoPlaces(*first, map_from_optical);
  if (!apart.empty()) faults_.emplace(stamp_ns, apart);
  return !apart.empty();
}

bool OnePlace::isBroken(const std::string& stream, const CaptureRecord& capture) {
  constexpr double kSame = 1e-3;  // more than rounding, and less than a minute or a cloud changes
  const Sky sky{capture.utc_text, capture.scene_illuminance_lx};
  const auto [first, is_first] = skies_.emplace(std::make_pair(stream, capture.stamp_ns), sky);
  if (is_first || faults_.count(capture.stamp_ns) != 0) return false;
  const auto [utc, lx] = first->second;
  const bool is_of_other_time = utc != sky.utc;
  const bool is_of_other_light = std::abs(lx - sky.illuminance_lx) > kSame * std::abs(lx);  // not by NaN
  if (!is_of_other_time && !is_of_other_light) return false;
  const std::string apart = is_of_other_time
                                ? "skies of " + utc + " and " + sky.utc
                                : textOf(lx, 6) + " and " + textOf(sky.illuminance_lx, 6) + " lx";
  faults_.emplace(capture.stamp_ns, "two captures of " + stream + " at this stamp tell of " + apart +
                                        ": are these two recordings?");
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
