#include "scattered_sky.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "sphere.h"
#include "table_place.h"

namespace sunlit::sky {

ScatteredSky::ScatteredSky(const RadiativeTransfer& transfer, double altitude_km, const AirLamp& lamp)
    : towards_(lamp.apparent.vector().cast<float>()),
      heading_(headingOf(towards_)),
      nodes_(static_cast<std::size_t>(kRows * kColumns)) {
  const double lamp_cos_zenith = lamp.geometric.vector().z();
  const double lamp_sin_zenith = std::sqrt(std::max(0.0, 1.0 - lamp_cos_zenith * lamp_cos_zenith));
  tbb::parallel_for(0, kRows, [&](int row) {
    const double t = static_cast<double>(row) / (kRows - 1);
    const double elevation = 0.5 * kPi * t * t;
    const double cos_zenith = std::sin(elevation);
    const SightPath path = transfer.sightFrom(altitude_km, cos_zenith);
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = kPi * column / (kColumns - 1);
      const double cos_angle =
          cos_zenith * lamp_cos_zenith + std::cos(elevation) * lamp_sin_zenith * std::cos(azimuth);
      const Scattered light = transfer.scattered(path, lamp_cos_zenith, cos_angle);
      nodes_[static_cast<std::size_t>(row * kColumns + column)] = {
          paddedColourOf(light.smooth * lamp.strength), paddedColourOf(light.aerosol * lamp.strength),
          paddedColourOf(light.aerosol_again * lamp.strength)};
    }
  });
}

Eigen::Array3f ScatteredSky::luminance(const Eigen::Vector3f& towards) const {
  const float elevation = elevationAboveHorizon(towards);
  const TablePlace row = placeAt(std::sqrt(elevation / kHalfPi) * (kRows - 1), kRows);
  const TablePlace column =
      placeAt(azimuthFrom(heading_, towards) * static_cast<float>((kColumns - 1) / kPi), kColumns);
  const Node* low = &nodes_[static_cast<std::size_t>(row.index * kColumns + column.index)];
  const Node* high = low + kColumns;
  const float u = column.fraction;
  const float v = row.fraction;
  const AerosolPhases phases = aerosolPhases(towards.dot(towards_));
  const auto blend = [&](const Node& node, float weight) -> Eigen::Array4f {
    return (node.smooth + node.aerosol * phases.once + node.aerosol_again * phases.again) * weight;
  };
  const Eigen::Array4f sum = blend(low[0], (1.0F - u) * (1.0F - v)) + blend(low[1], u * (1.0F - v)) +
                             blend(high[0], (1.0F - u) * v) + blend(high[1], u * v);
  return sum.head<3>();
}

}  // namespace sunlit::sky
