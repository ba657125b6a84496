/// Where triangles are looked at to know them whole.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// Places on a triangle, by the shares of its corners; first its middle.
inline const std::array<Eigen::Vector3f, 10> kTrianglePlaces = {{{0.3333f, 0.3333f, 0.3334f},
                                                                 {0.9f, 0.05f, 0.05f},
                                                                 {0.05f, 0.9f, 0.05f},
                                                                 {0.05f, 0.05f, 0.9f},
                                                                 {0.48f, 0.48f, 0.04f},
                                                                 {0.04f, 0.48f, 0.48f},
                                                                 {0.48f, 0.04f, 0.48f},
                                                                 {0.7f, 0.15f, 0.15f},
                                                                 {0.15f, 0.7f, 0.15f},
                                                                 {0.15f, 0.15f, 0.7f}}};

inline Eigen::Vector3f placeOn(const Geometry& geometry, std::uint32_t t, const Eigen::Vector3f& shares) {
  const auto& corners = geometry.triangles[t];
  Eigen::Vector3f place = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; k < 3; ++k) place += shares[static_cast<int>(k)] * geometry.positions[corners[k]];
  return place;
}

}  // namespace sunlit::light
