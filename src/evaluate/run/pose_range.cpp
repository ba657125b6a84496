#include "sunlit/evaluate/run/pose_range.h"

namespace sunlit::evaluate {

std::size_t PoseRange::size() const {
  const auto step = static_cast<std::size_t>(stride);
  return (count + step - 1) / step;
}

bool PoseRange::holds(std::int64_t pose) const {
  if (pose < first || (pose - first) % stride != 0) return false;
  return count == 0 || static_cast<std::size_t>(pose - first) < count;
}

}  // namespace sunlit::evaluate
