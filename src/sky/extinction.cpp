#include "extinction.h"

#include <cmath>

#include "table_place.h"

namespace sunlit::sky {

Extinction::Extinction(const RadiativeTransfer& transfer, double altitude_km) {
  const Eigen::Array3f white = colourOf(Spectrum::Ones()).value;
  for (int row = 0; row < kRows; ++row) {
    const double cos_zenith = std::sin(static_cast<double>(elevationOf(row)));
    rows_.push_back(transfer.transmittance(altitude_km, cos_zenith));
    colours_.push_back((colourOf(rows_.back()).value / white).max(0.0F));
  }
}

Eigen::Array3f Extinction::colour(float elevation) const {
  const TablePlace place = placeAt(rowOf(elevation), kRows);
  const auto low = static_cast<std::size_t>(place.index);
  return colours_[low] * (1.0F - place.fraction) + colours_[low + 1] * place.fraction;
}

}  // namespace sunlit::sky
