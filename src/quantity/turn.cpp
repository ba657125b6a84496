#include "sunlit/quantity/turn.h"

namespace sunlit {

Eigen::Quaterniond turnBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

}  // namespace sunlit
