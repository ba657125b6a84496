#include "transport.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "quadrature.h"
#include "ray_path.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/sky/daylight.h"
#include "table_place.h"

namespace sunlit::sky {
namespace {

constexpr float kIsotropic = static_cast<float>(1.0 / (4.0 * kPi));

// Heights of both tables lie closer near the ground: index = √(altitude / top) · (count − 1).
constexpr int kSunlightHeights = 48;
constexpr int kSunlightAngles = 128;
constexpr int kMeanHeights = 32;
// Sun positions of the multiple scattering table: steps of 0.5° from −22° to 8.6°, then wider and wider to
// the zenith.
constexpr float kLowestSun = -0.375F;
constexpr float kSunStep = 0.00875F;
constexpr float kEvenSunEnd = 60.0F;
constexpr float kSunBend = 0.00111F;
constexpr int kMeanSuns = 85;
// Until the next order adds less than this part to any node. The slowest are those of deep night; by day it
// is ten times less. That takes 6 orders over common ground, 9 over the whitest.
constexpr float kConverged = 0.03F;
constexpr int kMostOrders = 30;
constexpr int kGatherSteps = 28;
constexpr int kAzimuths = 8;
constexpr int kSightSteps = 48;

std::size_t at(int row, int column, int columns) {
  return static_cast<std::size_t>(row * columns + column);
}

double altitudeOf(int index, int count) {
  const double x = static_cast<double>(index) / (count - 1);
  return kAtmosphereHeight_km * x * x;
}

TablePlace altitudePlace(double altitude_km, int count) {
  const double x = std::sqrt(std::clamp(altitude_km / kAtmosphereHeight_km, 0.0, 1.0));
  return placeAt(static_cast<float>(x * (count - 1)), count);
}

float sunCoordinate(float cos_zenith) {
  const float even = (cos_zenith - kLowestSun) / kSunStep;
  if (even < kEvenSunEnd) {
    return std::max(even, 0.0F);
  }
  const float beyond = cos_zenith - (kLowestSun + kSunStep * kEvenSunEnd);
  return kEvenSunEnd +
         (std::sqrt(kSunStep * kSunStep + 4.0F * kSunBend * beyond) - kSunStep) / (2.0F * kSunBend);
}

float sunCosZenith(int index) {
  const float x = static_cast<float>(index);
  if (x <= kEvenSunEnd) {
    return kLowestSun + kSunStep * x;
  }
  const float beyond = x - kEvenSunEnd;
  return std::min(1.0F, kLowestSun + kSunStep * kEvenSunEnd + beyond * (kSunStep + kSunBend * beyond));
}

/// Part of the disc above the horizon for a centre `above` disc radii above it; smooth at both ends.
double visiblePart(double above) {
  const double x = std::clamp(above, -1.0, 1.0);
  return 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / kPi;
}

/// The nodes of the sunlight tables around a place, and their weights.
struct Corners {
  std::size_t first;
  std::array<float, 4> weights;
};
Corners sunlightCorners(double altitude_km, double above_horizon, double whole_range) {
  const TablePlace height = altitudePlace(altitude_km, kSunlightHeights);
  const double x = std::sqrt(std::max(0.0, above_horizon) / whole_range);
  const TablePlace angle = placeAt(static_cast<float>(x * (kSunlightAngles - 1)), kSunlightAngles);
  const float u = angle.fraction;
  const float v = height.fraction;
  return {at(height.index, angle.index, kSunlightAngles),
          {(1.0F - u) * (1.0F - v), u * (1.0F - v), (1.0F - u) * v, u * v}};
}

}  // namespace

Transport::Transport(const MediumParameters& parameters) : medium_(parameters) {
  tabulateSunlight();
  scatterManyTimes();
}

Spectrum Transport::transmittance(double altitude_km, double cos_zenith) const {
  if (segment(altitude_km, cos_zenith).hits_ground) {
    return Spectrum::Zero();
  }
  Spectrum depth = Spectrum::Zero();
  marchSight(altitude_km, cos_zenith, 160, [&](double distance_km, double step_km) {
    depth += medium_.at(altitudeAlong(altitude_km, cos_zenith, distance_km)).extinction *
             static_cast<float>(step_km);
  });
  return (-depth).exp();
}

void Transport::tabulateSunlight() {
  sunlight_.resize(static_cast<std::size_t>(kSunlightHeights * kSunlightAngles));
  aerosol_.resize(sunlight_.size());
  tbb::parallel_for(0, kSunlightHeights, [&](int i) {
    const double altitude_km = altitudeOf(i, kSunlightHeights);
    const double horizon = horizonCosZenith(altitude_km);
    for (int j = 0; j < kSunlightAngles; ++j) {
      const double x = static_cast<double>(j) / (kSunlightAngles - 1);
      // Just above the horizon, lest rounding lets a ray that should graze the ground end there.
      const double cos_zenith = horizon + (1.0 - horizon) * std::max(x * x, 1e-9);
      Spectrum depth = Spectrum::Zero();
      float aerosol_km = 0.0F;
      marchSight(altitude_km, cos_zenith, 160, [&](double distance_km, double step_km) {
        const double there_km = altitudeAlong(altitude_km, cos_zenith, distance_km);
        depth += medium_.at(there_km).scaled_extinction * static_cast<float>(step_km);
        aerosol_km += medium_.aerosolDensity(there_km) * static_cast<float>(step_km);
      });
      aerosol_[at(i, j, kSunlightAngles)] = aerosol_km;
      sunlight_[at(i, j, kSunlightAngles)] = (-depth).exp();
    }
  });
}

Spectrum Transport::scaledSunlight(double altitude_km, double sun_cos_zenith) const {
  const double horizon = horizonCosZenith(altitude_km);
  const double above = sun_cos_zenith - horizon;
  const auto part =
      static_cast<float>(visiblePart(above / (kSunRadiusAtOneAu.rad() * std::sqrt(1.0 - horizon * horizon))));
  if (part <= 0.0F) {
    return Spectrum::Zero();
  }
  const Corners c = sunlightCorners(altitude_km, above, 1.0 - horizon);
  const Spectrum* low = &sunlight_[c.first];
  const Spectrum* high = low + kSunlightAngles;
  return low[0] * (part * c.weights[0]) + low[1] * (part * c.weights[1]) + high[0] * (part * c.weights[2]) +
         high[1] * (part * c.weights[3]);
}

float Transport::aerosolTowardsSun(double altitude_km, double sun_cos_zenith) const {
  const double horizon = horizonCosZenith(altitude_km);
  const Corners c = sunlightCorners(altitude_km, sun_cos_zenith - horizon, 1.0 - horizon);
  const float* low = &aerosol_[c.first];
  const float* high = low + kSunlightAngles;
  return low[0] * c.weights[0] + low[1] * c.weights[1] + high[0] * c.weights[2] + high[1] * c.weights[3];
}

Spectrum Transport::interpolateMean(int altitude_index, float altitude_fraction, float sun_coordinate) const {
  const TablePlace sun = placeAt(sun_coordinate, kMeanSuns);
  const Spectrum* low = &mean_[at(altitude_index, sun.index, kMeanSuns)];
  const Spectrum* high = low + kMeanSuns;
  const float u = sun.fraction;
  const float v = altitude_fraction;
  return low[0] * ((1.0F - u) * (1.0F - v)) + low[1] * (u * (1.0F - v)) + high[0] * ((1.0F - u) * v) +
         high[1] * (u * v);
}

Spectrum Transport::meanRadiance(double altitude_km, double sun_cos_zenith) const {
  const TablePlace height = altitudePlace(altitude_km, kMeanHeights);
  return interpolateMean(height.index, height.fraction, sunCoordinate(static_cast<float>(sun_cos_zenith)));
}

Spectrum Transport::groundRadiance(double sun_cos_zenith) const {
  const TablePlace sun = placeAt(sunCoordinate(static_cast<float>(sun_cos_zenith)), kMeanSuns);
  const Spectrum* ground = &ground_[static_cast<std::size_t>(sun.index)];
  return ground[0] * (1.0F - sun.fraction) + ground[1] * sun.fraction;
}

Transport::Ray Transport::makeRay(double altitude_km, double cos_zenith, double weight) const {
  Ray ray;
  ray.cos_zenith = static_cast<float>(cos_zenith);
  ray.solid_angle_weight = static_cast<float>(weight);
  const double r = kEarthRadius_km + altitude_km;
  Spectrum transmittance = Spectrum::Ones();
  const auto add = [&](double distance_km, double step_km) {
    const double there_km = altitudeAlong(altitude_km, cos_zenith, distance_km);
    const LocalMedium local = medium_.at(there_km);
    const Spectrum depth = (local.scaled_extinction * static_cast<float>(step_km)).max(1e-12F);
    const Spectrum passed = (-depth).exp();
    RayStep step;
    step.weight =
        local.scaled_scattering * transmittance * ((1.0F - passed) / depth) * static_cast<float>(step_km);
    step.eye_part = static_cast<float>(r / (kEarthRadius_km + there_km));
    step.sight_part = static_cast<float>(distance_km / (kEarthRadius_km + there_km));
    step.altitude_km = static_cast<float>(there_km);
    const TablePlace place = altitudePlace(there_km, kMeanHeights);
    step.altitude_index = place.index;
    step.altitude_fraction = place.fraction;
    ray.steps.push_back(step);
    transmittance *= passed;
  };
  const Segment path = marchSight(altitude_km, cos_zenith, kGatherSteps, add);
  ray.ground_transmittance = path.hits_ground ? transmittance : Spectrum::Zero();
  ray.ground_eye_part = static_cast<float>(r / kEarthRadius_km);
  ray.ground_sight_part = static_cast<float>(path.length_km / kEarthRadius_km);
  return ray;
}

std::vector<Transport::Ray> Transport::raysFrom(double altitude_km) const {
  // The horizon is an edge, so each side has its own quadrature.
  const double horizon = horizonCosZenith(altitude_km);
  std::vector<Ray> rays;
  for (const Node& node : gaussLegendre(16, horizon, 1.0)) {
    rays.push_back(makeRay(altitude_km, node.x, 0.5 * node.weight));
  }
  for (const Node& node : gaussLegendre(6, -1.0, horizon)) {
    rays.push_back(makeRay(altitude_km, node.x, 0.5 * node.weight));
  }
  return rays;
}

namespace {

/// Cosines between a line of sight and the sun over half the azimuths; the other half mirrors them.
template <typename Visit>
void overAzimuths(float cos_zenith, double sun_cos_zenith, const Visit& visit) {
  const auto sun = static_cast<float>(sun_cos_zenith);
  const float across = std::sqrt(std::max(0.0F, (1.0F - cos_zenith * cos_zenith) * (1.0F - sun * sun)));
  for (int k = 0; k < kAzimuths; ++k) {
    visit(cos_zenith * sun + across * static_cast<float>(std::cos(kPi * (k + 0.5) / kAzimuths)));
  }
}

}  // namespace

Transport::Gathered Transport::gatherOnce(const std::vector<Ray>& rays, double sun_cos_zenith) const {
  Gathered result;
  for (const Ray& ray : rays) {
    Spectrum sum = Spectrum::Zero();
    overAzimuths(ray.cos_zenith, sun_cos_zenith, [&](float sun_cos_angle) {
      const auto sun = static_cast<float>(sun_cos_zenith);
      for (const RayStep& step : ray.steps) {
        sum += step.weight *
               scaledSunlight(step.altitude_km, sun * step.eye_part + sun_cos_angle * step.sight_part) *
               kIsotropic;
      }
    });
    const float weight = ray.solid_angle_weight / kAzimuths;
    result.mean += sum * weight;
    result.down += sum * (weight * std::max(0.0F, ray.cos_zenith) / kIsotropic);
  }
  return result;
}

Transport::Gathered Transport::gatherAgain(const std::vector<Ray>& rays, double sun_cos_zenith) const {
  Gathered result;
  for (const Ray& ray : rays) {
    Spectrum sum = Spectrum::Zero();
    overAzimuths(ray.cos_zenith, sun_cos_zenith, [&](float sun_cos_angle) {
      const auto sun = static_cast<float>(sun_cos_zenith);
      for (const RayStep& step : ray.steps) {
        const float sun_there = sun * step.eye_part + sun_cos_angle * step.sight_part;
        sum += step.weight *
               interpolateMean(step.altitude_index, step.altitude_fraction, sunCoordinate(sun_there));
      }
      if (ray.ground_transmittance[0] > 0.0F) {
        sum += ray.ground_transmittance *
               groundRadiance(sun * ray.ground_eye_part + sun_cos_angle * ray.ground_sight_part);
      }
    });
    const float weight = ray.solid_angle_weight / kAzimuths;
    result.mean += sum * weight;
    result.down += sum * (weight * std::max(0.0F, ray.cos_zenith) / kIsotropic);
  }
  return result;
}

void Transport::scatterManyTimes() {
  std::vector<std::vector<Ray>> rays(kMeanHeights);
  Spectra once(static_cast<std::size_t>(kMeanHeights * kMeanSuns));
  Spectra ground_once(static_cast<std::size_t>(kMeanSuns), Spectrum::Zero());
  const float ground_scale = static_cast<float>(medium_.parameters().ground_albedo / kPi);
  tbb::parallel_for(0, kMeanHeights, [&](int i) {
    std::vector<Ray>& from_here = rays[static_cast<std::size_t>(i)];
    from_here = raysFrom(altitudeOf(i, kMeanHeights));
    once[at(i, 0, kMeanSuns)] = Spectrum::Zero();  // below the lowest sun it is night
    for (int j = 1; j < kMeanSuns; ++j) {
      const float sun = sunCosZenith(j);
      const Gathered gathered = gatherOnce(from_here, sun);
      once[at(i, j, kMeanSuns)] = gathered.mean;
      if (i == 0) {
        const Spectrum beam = scaledSunlight(0.0, sun) * std::max(sun, 0.0F);
        ground_once[static_cast<std::size_t>(j)] = (gathered.down + beam) * ground_scale;
      }
    }
  });
  mean_ = once;
  ground_ = ground_once;
  float added = 1.0F;
  for (int order = 1; order < kMostOrders && added > kConverged; ++order) {
    added = 0.0F;
    // Each height sees what the heights below it already gained, which halves the passes needed.
    for (int i = 0; i < kMeanHeights; ++i) {
      Spectra row(static_cast<std::size_t>(kMeanSuns), Spectrum::Zero());
      Spectra ground = ground_once;
      tbb::parallel_for(1, kMeanSuns, [&](int j) {
        const auto sun = static_cast<std::size_t>(j);
        const Gathered gathered = gatherAgain(rays[static_cast<std::size_t>(i)], sunCosZenith(j));
        row[sun] = once[at(i, j, kMeanSuns)] + gathered.mean;
        ground[sun] += gathered.down * ground_scale;
      });
      for (int j = 1; j < kMeanSuns; ++j) {
        Spectrum& mean = mean_[at(i, j, kMeanSuns)];
        const Spectrum& now = row[static_cast<std::size_t>(j)];
        added = std::max(added, ((now - mean) / now.max(1e-20F)).maxCoeff());
        mean = now;
      }
      if (i == 0) {
        ground_ = ground;
      }
    }
  }
}

// Aerosol scatters so far ahead that light which it scattered often still comes from near the sun. Of what it
// scatters, the scaled medium lets a part g pass. Along a path on which that part has the optical depth x, it
// meets no such scattering with probability e^−x, and n of them with xⁿ e^−x / n!. So light scattered once is
// dimmed by e^−x more than the scaled medium says, and the rest of what passed, 1 − e^−x − x e^−x in all, was
// scattered twice or more.
Scattered Transport::scattered(const View& view) const {
  Scattered result;
  const double r = kEarthRadius_km + view.altitude_km;
  const float phase = rayleighPhase(static_cast<float>(view.sun_cos_angle));
  const float wide_phase = aerosolWidePhase(static_cast<float>(view.sun_cos_angle));
  const Spectrum forward_per_km = medium_.forwardAtSeaLevel();
  Spectrum transmittance = Spectrum::Ones();
  float aerosol_km = 0.0F;
  const auto add = [&](double distance_km, double step_km) {
    const double there_km = altitudeAlong(view.altitude_km, view.cos_zenith, distance_km);
    const LocalMedium local = medium_.at(there_km);
    const double sun =
        (r * view.sun_cos_zenith + distance_km * view.sun_cos_angle) / (kEarthRadius_km + there_km);
    const Spectrum depth = (local.scaled_extinction * static_cast<float>(step_km)).max(1e-12F);
    const Spectrum passed = (-depth).exp();
    const Spectrum weight = transmittance * ((1.0F - passed) / depth) * static_cast<float>(step_km);
    const Spectrum sunlit = weight * scaledSunlight(there_km, sun);
    const float step_aerosol_km = medium_.aerosolDensity(there_km) * static_cast<float>(step_km);
    const float in_all_km = aerosol_km + 0.5F * step_aerosol_km + aerosolTowardsSun(there_km, sun);
    const Spectrum x = (forward_per_km * in_all_km).max(1e-4F);  // below, the quotient loses its digits
    const Spectrum never = (-x).exp();
    const Spectrum by_aerosol = sunlit * local.aerosol_scattering;
    result.smooth += sunlit * local.rayleigh_scattering * phase + by_aerosol * (1.0F - never) * wide_phase +
                     weight * local.scaled_scattering * meanRadiance(there_km, sun);
    result.aerosol += by_aerosol * never;
    result.aerosol_again += by_aerosol * ((1.0F - never) / x - never) * kAerosolForwardPart;
    transmittance *= passed;
    aerosol_km += step_aerosol_km;
  };
  const Segment path = marchSight(view.altitude_km, view.cos_zenith, kSightSteps, add);
  if (path.hits_ground) {
    const double sun = (r * view.sun_cos_zenith + path.length_km * view.sun_cos_angle) / kEarthRadius_km;
    result.smooth += transmittance * groundRadiance(sun);
  }
  return result;
}

}  // namespace sunlit::sky
