#include "evaluate/run/one_place.h"

#include "sunlit/evaluate/same_place.h"

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

void OnePlace::noteImage(std::int64_t stamp_ns) {
  const auto [found, is_first] = first_.emplace(stamp_ns, std::nullopt);
  if (is_first) found->second = waiting_.take(stamp_ns);
}

std::string OnePlace::fault(std::int64_t stamp_ns) const {
  const auto found = faults_.find(stamp_ns);
  return found == faults_.end() ? "" : found->second;
}

}  // namespace sunlit::evaluate
