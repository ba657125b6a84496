#include "air_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "sphere.h"
#include "table_place.h"

namespace sunlit::sky {
namespace {

constexpr float kNear_km = 4.0F;
// Below the horizon the air has no end; after this there is none of the light left.
constexpr double kFarBelow_km = 400.0;

double cosZenithOf(int row) {
  const double x = static_cast<double>(row) / AirSights::kHalfRows - 1.0;
  return x < 0.0 ? -x * x : x * x;
}

/// Steps even in u, and of the last cut even in the root of distance.
std::vector<double> edgesWithCuts(double length_km, std::vector<std::size_t>* steps_to_cut) {
  std::vector<double> edges_km = {0.0};
  steps_to_cut->push_back(0);
  const auto addTo = [&](double to_km, int count) {
    const double from_km = edges_km.back();
    for (int i = 1; i <= count; ++i) {
      const double t = static_cast<double>(i) / count;
      edges_km.push_back(from_km + (to_km - from_km) * t * (0.3 + 0.7 * t));
    }
    steps_to_cut->push_back(edges_km.size() - 1);
  };
  for (int cut = 1; cut + 1 < AirSights::kCuts; ++cut) {
    const double u = static_cast<double>(cut) / (AirSights::kCuts - 1);
    const double to_km = std::min(kNear_km * u / (1.0 - u), 0.999 * length_km);
    addTo(std::max(to_km, edges_km.back()), cut < AirSights::kCuts - 8 ? 1 : 3);
  }
  addTo(length_km, 10);
  return edges_km;
}

}  // namespace

AirSights::AirSights(const RadiativeTransfer& transfer, double altitude_km) {
  const Eigen::Array3f white = colourOf(Spectrum::Ones()).value;
  for (int row = 0; row < kRows; ++row) {
    const double cos_zenith = cosZenithOf(row);
    const double length_km = cos_zenith < 0.0 ? kFarBelow_km : segment(altitude_km, cos_zenith).length_km;
    Sight sight;
    const std::vector<double> edges_km = edgesWithCuts(length_km, &sight.steps_to_cut);
    sight.path = sightPath(transfer.medium(), transfer.sunlight(), {altitude_km, cos_zenith}, edges_km);
    Spectrum depth = Spectrum::Zero();
    std::size_t step = 0;
    for (const std::size_t cut : sight.steps_to_cut) {
      for (; step < cut; ++step) {
        const auto step_km = static_cast<float>(edges_km[step + 1] - edges_km[step]);
        depth += transfer.medium().at(sight.path.steps[step].middle.altitude_km).extinction * step_km;
      }
      const Eigen::Array3f passed = (colourOf((-depth).exp()).value / white).max(0.0F);
      transmittance_.emplace_back(passed[0], passed[1], passed[2], 0.0F);
    }
    sights_.push_back(std::move(sight));
  }
}

AirSights::Place AirSights::placeOf(float z, float distance_km) {
  const float x = std::copysign(std::sqrt(std::min(std::abs(z), 1.0F)), z);
  const TablePlace row = placeAt((x + 1.0F) * kHalfRows, kRows);
  const float u = distance_km / (distance_km + kNear_km);
  const TablePlace cut = placeAt(u * (kCuts - 1), kCuts);
  const float a = row.fraction;
  const float b = cut.fraction;
  return {static_cast<std::size_t>(row.index * kCuts + cut.index),
          {(1.0F - a) * (1.0F - b), (1.0F - a) * b, a * (1.0F - b), a * b}};
}

Eigen::Array4f AirSights::transmittance(const Place& place) const {
  const Eigen::Array4f* low = &transmittance_[place.first];
  const Eigen::Array4f* high = low + kCuts;
  return low[0] * place.weights[0] + low[1] * place.weights[1] + high[0] * place.weights[2] +
         high[1] * place.weights[3];
}

LitAir::LitAir(const RadiativeTransfer& transfer, const AirSights& sights, const AirLamp& lamp)
    : towards_(lamp.apparent.vector().cast<float>()),
      heading_(headingOf(towards_)),
      nodes_(static_cast<std::size_t>(kColumns * AirSights::kRows * AirSights::kCuts)) {
  const double lamp_cos_zenith = lamp.geometric.vector().z();
  const double lamp_sin_zenith = std::sqrt(std::max(0.0, 1.0 - lamp_cos_zenith * lamp_cos_zenith));
  tbb::parallel_for(0, AirSights::kRows, [&](int row) {
    const AirSights::Sight& sight = sights.sights_[static_cast<std::size_t>(row)];
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = kPi * column / (kColumns - 1);
      const double cos_angle = std::clamp(sight.path.cos_zenith * lamp_cos_zenith +
                                              sight.path.sin_zenith * lamp_sin_zenith * std::cos(azimuth),
                                          -1.0, 1.0);
      const SunAlong sun(sight.path, lamp_cos_zenith, cos_angle);
      const float again = aerosolAgainPhase(static_cast<float>(cos_angle));
      Scattered light;
      std::size_t step = 0;
      Node* node = &nodes_[static_cast<std::size_t>((column * AirSights::kRows + row) * AirSights::kCuts)];
      for (const std::size_t cut : sight.steps_to_cut) {
        for (; step < cut; ++step) {
          transfer.addStep(sight.path.steps[step], sun, cos_angle, &light);
        }
        *node++ = {paddedColourOf((light.smooth + light.aerosol_again * again) * lamp.strength),
                   paddedColourOf(light.aerosol * lamp.strength)};
      }
    }
  });
}

Eigen::Array4f LitAir::airlight(const Eigen::Vector3f& towards, const AirSights::Place& place) const {
  const TablePlace column =
      placeAt(azimuthFrom(heading_, towards) * static_cast<float>((kColumns - 1) / kPi), kColumns);
  const float phase = aerosolPhases(towards.dot(towards_)).once;
  constexpr auto kPerColumn = static_cast<std::size_t>(AirSights::kRows) * AirSights::kCuts;
  const Node* left = &nodes_[static_cast<std::size_t>(column.index) * kPerColumn + place.first];
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (const float share : {1.0F - column.fraction, column.fraction}) {
    const Node* high = left + AirSights::kCuts;
    sum += ((left[0].smooth + left[0].aerosol * phase) * place.weights[0] +
            (left[1].smooth + left[1].aerosol * phase) * place.weights[1] +
            (high[0].smooth + high[0].aerosol * phase) * place.weights[2] +
            (high[1].smooth + high[1].aerosol * phase) * place.weights[3]) *
           share;
    left += kPerColumn;
  }
  return sum;
}

}  // namespace sunlit::sky
