// Included by whatever is compiled for arm64, ahead of all else. Eigen knows vectors of two floats there,
// where on x86-64 it has those of four alone, and would sum up three floats in another order.
#pragma once

#include <Eigen/Core>

namespace Eigen::internal {
template <int kSize>
struct find_best_packet<float, kSize> {
  using type = packet_traits<float>::type;
};
}  // namespace Eigen::internal
