#include "diffuse_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "heights.h"
#include "quadrature.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::sky {
namespace {

constexpr int kHeights = 32;
// Sun positions: steps of 0.5° from −22° to 8.6°, then wider and wider to the zenith.
constexpr float kSunStep = 0.00875F;
constexpr float kEvenSunEnd = 60.0F;
constexpr float kSunBend = 0.00111F;
constexpr int kSuns = 85;
// Until the next order adds less than this part to any node; what is still to come is summed as a geometric
// series. The slowest nodes are those of deep night; by day it is ten times less. Against orders down to
// 0.003 and twice the rays and steps the sky is within 4 % (1 % down to −6°).
constexpr float kConverged = 0.25F;
constexpr int kMostOrders = 30;
constexpr int kSteps = 24;
constexpr int kAzimuths = 7;
constexpr int kRaysNearHorizon = 7;
constexpr int kRaysUp = 5;
constexpr double kNearHorizon = 0.15;  // in the cosine of zenith
constexpr int kRaysDown = 4;

std::size_t at(int height, int sun) {
  return static_cast<std::size_t>(height * kSuns + sun);
}

float sunCoordinate(float cos_zenith) {
  const float even = (cos_zenith - DiffuseLight::kLowestSun) / kSunStep;
  if (even < kEvenSunEnd) {
    return std::max(even, 0.0F);
  }
  const float beyond = cos_zenith - (DiffuseLight::kLowestSun + kSunStep * kEvenSunEnd);
  return kEvenSunEnd +
         (std::sqrt(kSunStep * kSunStep + 4.0F * kSunBend * beyond) - kSunStep) / (2.0F * kSunBend);
}

float sunCosZenith(int index) {
  const auto x = static_cast<float>(index);
  if (x <= kEvenSunEnd) {
    return DiffuseLight::kLowestSun + kSunStep * x;
  }
  const float beyond = x - kEvenSunEnd;
  return std::min(
      1.0F, DiffuseLight::kLowestSun + kSunStep * kEvenSunEnd + beyond * (kSunStep + kSunBend * beyond));
}

/// The spherical harmonics of Moments at a direction with the height `z` and the part `x` towards the sun's
/// azimuth, so normalised that the mean of each one's square over the sphere is 1.
std::array<float, kMoments> harmonics(float z, float x) {
  const float z2 = z * z;
  const float x2 = x * x;
  const float y2 = std::max(0.0F, 1.0F - z2 - x2);
  const float twice = x2 - y2;  // sinᵐθ cos mφ
  const float thrice = x * (x2 - 3.0F * y2);
  const float four_times = x2 * x2 - 6.0F * x2 * y2 + y2 * y2;
  return {1.0F,
          1.7320508F * z,
          1.7320508F * x,
          1.1180340F * (3.0F * z2 - 1.0F),
          3.8729833F * x * z,
          1.9364917F * twice,
          1.3228757F * z * (5.0F * z2 - 3.0F),
          1.6201852F * x * (5.0F * z2 - 1.0F),
          5.1234754F * z * twice,
          2.0916501F * thrice,
          0.375F * ((35.0F * z2 - 30.0F) * z2 + 3.0F),
          2.3717082F * x * z * (7.0F * z2 - 3.0F),
          1.6770510F * (7.0F * z2 - 1.0F) * twice,
          6.2749502F * z * thrice,
          2.2185299F * four_times};
}

/// What each degree of the radiance keeps when aerosol scatters it widely.
const std::array<float, kDegrees>& wideAerosol() {
  static const std::array<float, kDegrees> moments = [] {
    std::array<float, kDegrees> cut_off = aerosolWideMoments();
    // Half of the last degree: the mean of the sums with and without it, which swing about what all would
    // give.
    cut_off.back() *= 0.5F;
    return cut_off;
  }();
  return moments;
}
constexpr float kAirSecondDegree = 0.1F;  // of Rayleigh's phase function; the first degree is zero
// Where aerosol scatters less than this part of what air does, only what air can tell apart is looked up.
constexpr float kLittleAerosol = 0.003F;

Moments zeroMoments() {
  Moments zero;
  zero.fill(Spectrum::Zero());
  return zero;
}

/// Goes up whenever the numbers of the same medium change.
constexpr int kVersion = 1;

/// Of the numbers of a medium, exactly.
std::string nameOf(const MediumParameters& medium) {
  std::ostringstream name;
  name << "diffuse light " << kVersion << std::hexfloat;
  for (const double value :
       {medium.turbidity, medium.aerosol_albedo, medium.ozone_du, medium.ground_albedo, medium.refractivity})
    name << ' ' << value;
  return name.str();
}

/// Calls visit(cosine to the sun, x of the direction) over half the azimuths; the other half mirrors them.
template <typename Visit>
void overAzimuths(const SightPath& path, double sun_cos_zenith, const Visit& visit) {
  const double sun_sine = std::sqrt(std::max(0.0, 1.0 - sun_cos_zenith * sun_cos_zenith));
  for (int k = 0; k < kAzimuths; ++k) {
    const double x = path.sin_zenith * std::cos(kPi * (k + 0.5) / kAzimuths);
    visit(path.cos_zenith * sun_cos_zenith + x * sun_sine, static_cast<float>(x));
  }
}

}  // namespace

DiffuseLight::DiffuseLight(const Medium& medium, const Sunlight& sunlight, const TableStore& kept)
    : field_(static_cast<std::size_t>(kHeights * kSuns), zeroMoments()),
      ground_(static_cast<std::size_t>(kSuns), Spectrum::Zero()),
      ground_scale_(static_cast<float>(medium.parameters().ground_albedo / kPi)) {
  const std::string name = nameOf(medium.parameters());
  if (kept.find && take(kept.find(name))) return;
  compute(medium, sunlight);
  if (kept.keep) kept.keep(name, numbers());
}

void DiffuseLight::compute(const Medium& medium, const Sunlight& sunlight) {
  rays_.resize(kHeights);
  once_ = field_;
  ground_once_ = ground_;
  scatterOnce(medium, sunlight);
  field_ = once_;
  ground_ = ground_once_;
  Spectra gained(field_.size(), Spectrum::Zero());
  Spectra rest = gained;
  float added = 1.0F;
  for (int order = 1; order < kMostOrders && added > kConverged; ++order) {
    added = addOrder(&gained, &rest);
  }
  for (std::size_t node = 0; node < field_.size(); ++node) {
    field_[node][0] += rest[node];
  }
  gatherAt(0, &ground_);
  rays_.clear();
  once_ = Field();
  ground_once_ = Spectra();
}

/// The field, node by node, and the ground.
std::vector<float> DiffuseLight::numbers() const {
  std::vector<float> numbers;
  const auto add = [&](const Spectrum& spectrum) {
    numbers.insert(numbers.end(), spectrum.data(), spectrum.data() + kBands);
  };
  for (const Moments& node : field_)
    for (const Spectrum& moment : node) add(moment);
  for (const Spectrum& ground : ground_) add(ground);
  return numbers;
}

/// False: these are no numbers().
bool DiffuseLight::take(const std::vector<float>& numbers) {
  if (numbers.size() != (field_.size() * kMoments + ground_.size()) * kBands) return false;
  const float* next = numbers.data();
  const auto set = [&](Spectrum* spectrum) {
    std::copy_n(next, kBands, spectrum->data());
    next += kBands;
  };
  for (Moments& node : field_)
    for (Spectrum& moment : node) set(&moment);
  for (Spectrum& ground : ground_) set(&ground);
  return true;
}

std::vector<DiffuseLight::Ray> DiffuseLight::raysFrom(const Medium& medium, const Sunlight& sunlight,
                                                      double altitude_km) const {
  // The horizon is an edge, so each side has its own quadrature.
  const double horizon = horizonCosZenith(altitude_km);
  std::vector<Ray> rays;
  const auto add = [&](const Node& node) {
    rays.push_back(
        {sightPath(medium, sunlight, {altitude_km, node.x}, sightEdges(medium, altitude_km, node.x, kSteps)),
         static_cast<float>(0.5 * node.weight)});
  };
  for (const Node& node : gaussLegendre(kRaysNearHorizon, horizon, horizon + kNearHorizon)) {
    add(node);
  }
  for (const Node& node : gaussLegendre(kRaysUp, horizon + kNearHorizon, 1.0)) {
    add(node);
  }
  for (const Node& node : gaussLegendre(kRaysDown, -1.0, horizon)) {
    add(node);
  }
  return rays;
}

template <typename Radiance>
DiffuseLight::Gathered DiffuseLight::gather(const std::vector<Ray>& rays, double sun_cos_zenith,
                                            const Radiance& radiance) const {
  constexpr auto kSphere = static_cast<float>(4.0 * kPi);
  Gathered result;
  result.moments = zeroMoments();
  for (const Ray& ray : rays) {
    const auto z = static_cast<float>(ray.path.cos_zenith);
    const float weight = ray.weight / kAzimuths;
    overAzimuths(ray.path, sun_cos_zenith, [&](double sun_cos_angle, float x) {
      const Spectrum light =
          radiance(ray.path, SunAlong(ray.path, sun_cos_zenith, sun_cos_angle), sun_cos_angle) * weight;
      const std::array<float, kMoments> shape = harmonics(z, x);
      for (std::size_t i = 0; i < kMoments; ++i) {
        result.moments[i] += light * shape[i];
      }
      result.down += light * (kSphere * std::max(0.0F, z));
    });
  }
  return result;
}

void DiffuseLight::scatterOnce(const Medium& medium, const Sunlight& sunlight) {
  tbb::parallel_for(0, kHeights, [&](int i) {
    std::vector<Ray>& rays = rays_[static_cast<std::size_t>(i)];
    rays = raysFrom(medium, sunlight, heightOf(i, kHeights));
    for (int j = 1; j < kSuns; ++j) {  // below the lowest sun it is night
      const float sun_cos_zenith = sunCosZenith(j);
      const Gathered gathered =
          gather(rays, sun_cos_zenith, [&](const SightPath& path, const SunAlong& sun, double cos_angle) {
            const float air = rayleighPhase(static_cast<float>(cos_angle));
            const float aerosol = aerosolWidePhase(static_cast<float>(cos_angle));
            Spectrum sum = Spectrum::Zero();
            for (const SightStep& step : path.steps) {
              sum += (step.by_air * air + step.by_aerosol * aerosol) *
                     sunlight.at(step.sunlight, sun.cosineTo(step.middle.up)).scaled;
            }
            return sum;
          });
      once_[at(i, j)] = gathered.moments;
      if (i == 0) {
        const Spectrum beam = sunlight.at(0.0, sun_cos_zenith).scaled * std::max(sun_cos_zenith, 0.0F);
        ground_once_[static_cast<std::size_t>(j)] = (gathered.down + beam) * ground_scale_;
      }
    }
  });
}

/// All orders at one height, from what the field holds so far; at the lowest, `ground` too.
DiffuseLight::Field DiffuseLight::gatherAt(int height, Spectra* ground) const {
  const auto along = [&](const SightPath& path, const SunAlong& sun, double) -> Spectrum {
    Spectrum sum = Spectrum::Zero();
    for (const SightStep& step : path.steps) {
      sum += towardsEye(step, sun);
    }
    if (path.hits_ground) {
      sum += path.transmittance * this->ground(sun.cosineTo(path.end.up));
    }
    return sum;
  };
  Field row(static_cast<std::size_t>(kSuns), zeroMoments());
  Spectra lit_ground = ground_once_;
  tbb::parallel_for(1, kSuns, [&](int j) {
    const auto column = static_cast<std::size_t>(j);
    const Gathered gathered = gather(rays_[static_cast<std::size_t>(height)], sunCosZenith(j), along);
    row[column] = once_[at(height, j)];
    for (std::size_t m = 0; m < kMoments; ++m) {
      row[column][m] += gathered.moments[m];
    }
    lit_ground[column] += gathered.down * ground_scale_;
  });
  if (height == 0) {
    *ground = lit_ground;
  }
  return row;
}

/// Adds an order of scattering, and says how much it added at most. `gained` is what each node gained, `rest`
/// what it has still to gain if that goes on as a geometric series.
float DiffuseLight::addOrder(Spectra* gained, Spectra* rest) {
  float added = 0.0F;
  // Each height sees what the heights below it already gained, which halves the passes needed.
  for (int i = 0; i < kHeights; ++i) {
    const Field row = gatherAt(i, &ground_);
    for (int j = 1; j < kSuns; ++j) {
      const std::size_t node = at(i, j);
      const Spectrum& now = row[static_cast<std::size_t>(j)][0];
      const Spectrum gain = now - field_[node][0];
      added = std::max(added, (gain / now.max(1e-20F)).maxCoeff());
      const Spectrum ratio = (gain / (*gained)[node].max(1e-30F)).max(0.0F).min(0.7F);
      (*gained)[node] = gain;
      (*rest)[node] = gain * ratio / (1.0F - ratio);
      field_[node] = row[static_cast<std::size_t>(j)];
    }
  }
  return added;
}

Spectrum DiffuseLight::towardsEye(const SightStep& step, const SunAlong& sun) const {
  const double sun_up = sun.cosineTo(step.middle.up);
  const double sun_level = std::sqrt(std::max(1e-6, 1.0 - sun_up * sun_up));
  const double x = std::clamp((sun.cosineTo(step.middle.direction) - step.z * sun_up) / sun_level,
                              -step.level, step.level);
  const std::array<float, kMoments> shape = harmonics(static_cast<float>(step.z), static_cast<float>(x));

  const TablePlace height = heightPlace(step.height_root, kHeights);
  const TablePlace place = placeAt(sunCoordinate(static_cast<float>(sun_up)), kSuns);
  const Moments* low = &field_[at(height.index, place.index)];
  const std::array<const Moments*, 4> nodes = {low, low + 1, low + kSuns, low + kSuns + 1};
  const float u = place.fraction;
  const float v = height.fraction;
  const std::array<float, 4> shares = {(1.0F - u) * (1.0F - v), u * (1.0F - v), (1.0F - u) * v, u * v};
  const auto degree = [&](int first, int end) {
    Spectrum sum = Spectrum::Zero();
    for (std::size_t n = 0; n < 4; ++n) {
      const Spectrum* node = nodes[n]->data();
      for (int m = first; m < end; ++m) {
        sum += node[m] * (shares[n] * shape[static_cast<std::size_t>(m)]);
      }
    }
    return sum;
  };
  const Spectrum mean = degree(0, 1);
  const Spectrum second = degree(3, 6);
  const Spectrum from_air = step.by_air * (mean + second * kAirSecondDegree);
  const std::array<float, kDegrees>& wide = wideAerosol();
  if (step.by_aerosol[kBands - 1] < kLittleAerosol * step.by_air[kBands - 1]) {
    return from_air + step.by_aerosol * (mean * wide[0] + second * wide[2]);
  }
  return from_air + step.by_aerosol * (mean * wide[0] + degree(1, 3) * wide[1] + second * wide[2] +
                                       degree(6, 10) * wide[3] + degree(10, 15) * wide[4]);
}

Spectrum DiffuseLight::ground(double sun_cos_zenith) const {
  const TablePlace sun = placeAt(sunCoordinate(static_cast<float>(sun_cos_zenith)), kSuns);
  const Spectrum* low = &ground_[static_cast<std::size_t>(sun.index)];
  return low[0] * (1.0F - sun.fraction) + low[1] * sun.fraction;
}

}  // namespace sunlit::sky
