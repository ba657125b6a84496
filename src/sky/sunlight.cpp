#include "sunlight.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "heights.h"
#include "ray_path.h"
#include "sunlit/sky/daylight.h"
#include "sunlit/sky/disc_segment.h"
#include "table_place.h"

namespace sunlit::sky {
namespace {

constexpr int kHeights = 48;
constexpr int kAngles = 128;
constexpr int kSteps = 160;

/// Cosine of zenith of node `j`, closer near the horizon.
double nodeCosZenith(int j, double horizon) {
  const double x = static_cast<double>(j) / (kAngles - 1);
  return horizon + (1.0 - horizon) * x * x;
}

/// Apparent direction of a ray that just misses the ground.
double apparentHorizon(const Medium& medium, double altitude_km) {
  const double sine = (1.0 + medium.refractivity(0.0)) * kEarthRadius_km /
                      ((1.0 + medium.refractivity(altitude_km)) * (kEarthRadius_km + altitude_km));
  return -std::sqrt(std::max(0.0, 1.0 - sine * sine));
}

}  // namespace

struct Sunlight::Row {
  Spectra depth;
  std::vector<float> aerosol_km;
  std::vector<double> true_cos_zenith;
};

/// Rays by apparent direction, evenly as in nodeCosZenith().
Sunlight::Row Sunlight::makeRow(const Medium& medium, double altitude_km) const {
  Row row;
  const double horizon = apparentHorizon(medium, altitude_km);
  std::vector<double> apparent;
  for (int j = 0; j < kAngles; ++j) {
    // Just above the horizon, lest rounding lets a ray that should graze the ground end there.
    const double cos_zenith = std::max(nodeCosZenith(j, horizon), horizon + 1e-9);
    Spectrum depth = Spectrum::Zero();
    float aerosol_km = 0.0F;
    const RayPoint end =
        followRay(medium, {altitude_km, cos_zenith}, sightEdges(medium, altitude_km, cos_zenith, kSteps),
                  [&](const RayPoint& point, double step_km) {
                    depth += medium.at(point.altitude_km).scaled_extinction * static_cast<float>(step_km);
                    aerosol_km += medium.aerosolDensity(point.altitude_km) * static_cast<float>(step_km);
                  });
    apparent.push_back(cos_zenith);
    row.depth.push_back(depth);
    row.aerosol_km.push_back(aerosol_km);
    row.true_cos_zenith.push_back(end.direction.y());
  }
  for (int j = 0; j < kAngles; ++j) {
    const auto low = static_cast<std::size_t>(std::max(j - 1, 0));
    const auto high = static_cast<std::size_t>(std::min(j + 1, kAngles - 1));
    const double spread =
        (row.true_cos_zenith[high] - row.true_cos_zenith[low]) / (apparent[high] - apparent[low]);
    row.depth[static_cast<std::size_t>(j)] += static_cast<float>(std::log(std::max(spread, 0.1)));
  }
  return row;
}

Sunlight::Sunlight(const Medium& medium) {
  depth_.resize(static_cast<std::size_t>(kHeights * kAngles));
  aerosol_km_.resize(depth_.size());
  lift_.resize(kHeights);
  tbb::parallel_for(0, kHeights, [&](int i) {
    const double altitude_km = heightOf(i, kHeights);
    const Row row = makeRow(medium, altitude_km);
    const double horizon = row.true_cos_zenith.front();
    lift_[static_cast<std::size_t>(i)] =
        static_cast<float>(std::acos(horizon) - std::acos(horizonCosZenith(altitude_km)));
    std::size_t from = 0;
    for (int j = 0; j < kAngles; ++j) {
      const double wanted = nodeCosZenith(j, horizon);
      while (from + 2 < row.depth.size() && row.true_cos_zenith[from + 1] < wanted) {
        ++from;
      }
      const double low = std::sqrt(std::max(0.0, row.true_cos_zenith[from] - horizon));
      const double high = std::sqrt(std::max(0.0, row.true_cos_zenith[from + 1] - horizon));
      const auto t = static_cast<float>(
          std::clamp((std::sqrt(std::max(0.0, wanted - horizon)) - low) / (high - low), 0.0, 1.0));
      const auto node = static_cast<std::size_t>(i * kAngles + j);
      depth_[node] = row.depth[from] * (1.0F - t) + row.depth[from + 1] * t;
      aerosol_km_[node] = row.aerosol_km[from] * (1.0F - t) + row.aerosol_km[from + 1] * t;
    }
  });
}

Sunlight::Height Sunlight::heightAt(double altitude_km) const {
  const TablePlace place = heightPlace(heightRoot(altitude_km), kHeights);
  const auto row = static_cast<std::size_t>(place.index);
  const double lift = lift_[row] + (lift_[row + 1] - lift_[row]) * place.fraction;
  // cos(a + lift) of the straight horizon's angle a, to third order in `lift`.
  const double straight = horizonCosZenith(altitude_km);
  const double sine = std::sqrt(1.0 - straight * straight);
  const double horizon = straight * (1.0 - 0.5 * lift * lift) - sine * lift;
  return {place, horizon, kSunRadiusAtOneAu.rad() * sine};
}

Beam Sunlight::at(const Height& height, double sun_cos_zenith) const {
  const double above = sun_cos_zenith - height.horizon;
  const auto part = static_cast<float>(discSegment(above / height.radius));
  if (part <= 0.0F) {
    return {Spectrum::Zero(), 0.0F};
  }
  const double x = std::sqrt(std::max(0.0, above) / (1.0 - height.horizon));
  const TablePlace angle = placeAt(static_cast<float>(x * (kAngles - 1)), kAngles);
  const std::size_t first =
      static_cast<std::size_t>(height.row.index) * kAngles + static_cast<std::size_t>(angle.index);
  const float up = height.row.fraction;
  const float a = (1.0F - angle.fraction) * (1.0F - up);
  const float b = angle.fraction * (1.0F - up);
  const float c = (1.0F - angle.fraction) * up;
  const float d = angle.fraction * up;
  const Spectrum* low = &depth_[first];
  const Spectrum* high = low + kAngles;
  const float* low_km = &aerosol_km_[first];
  const float* high_km = low_km + kAngles;
  return {(low[0] * -a - low[1] * b - high[0] * c - high[1] * d).exp() * part,
          low_km[0] * a + low_km[1] * b + high_km[0] * c + high_km[1] * d};
}

}  // namespace sunlit::sky
