#include "medium.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sunlit/quantity/angle.h"
#include "table_place.h"

namespace sunlit::sky {
namespace {

constexpr int kLayers = 1000;
constexpr double kLayer_km = kAtmosphereHeight_km / kLayers;
/// As in 6S (Vermote et al. 1997). At the horizon the aerosol's air mass is then 77; Gueymard 1995 (SMARTS)
/// has 68.
constexpr double kAerosolScaleHeight_km = 2.0;

struct AirDensity {
  double altitude_km, kg_per_m3;
};
/// US Standard Atmosphere 1976, table I.
constexpr std::array<AirDensity, 14> kAir = {{{0, 1.225},
                                              {5, 0.7364},
                                              {10, 0.4135},
                                              {15, 0.1948},
                                              {20, 0.08891},
                                              {25, 0.04008},
                                              {30, 0.01841},
                                              {40, 3.996e-3},
                                              {50, 1.027e-3},
                                              {60, 3.097e-4},
                                              {70, 8.283e-5},
                                              {80, 1.846e-5},
                                              {90, 3.416e-6},
                                              {100, 5.604e-7}}};

double airDensity(double altitude_km) {
  std::size_t i = 0;
  while (i + 2 < kAir.size() && altitude_km > kAir[i + 1].altitude_km) {
    ++i;
  }
  const double t = (altitude_km - kAir[i].altitude_km) / (kAir[i + 1].altitude_km - kAir[i].altitude_km);
  return std::pow(kAir[i].kg_per_m3, 1.0 - t) * std::pow(kAir[i + 1].kg_per_m3, t);
}

/// A tent from 10 to 40 km with its top at 25 km (Bruneton 2017), of integral 1.
double ozoneDensity(double altitude_km) {
  return std::max(0.0, 1.0 - std::abs(altitude_km - 25.0) / 15.0) / 15.0;
}

struct Lobe {
  float weight, asymmetry;
};
/// Mean cosine 0.69, about that of continental aerosol in the visible (Hess et al. 1998, OPAC: 0.70 at 550
/// nm).
constexpr std::array<Lobe, 2> kAerosolLobes = {{{0.6F, 0.82F}, {0.4F, 0.5F}}};

/// Henyey and Greenstein 1941, 1/sr.
float henyeyGreenstein(float cos_angle, float g) {
  constexpr float kPerSphere = static_cast<float>(1.0 / (4.0 * kPi));
  const float base = 1.0F + g * g - 2.0F * g * cos_angle;
  return kPerSphere * (1.0F - g * g) / (base * std::sqrt(base));
}

/// The height at which aerosolPhase() must be cut off to leave 1 − g of it.
float widePhaseLimit() {
  float low = 0.0F;
  float high = 1.0F;
  for (int i = 0; i < 24; ++i) {
    const float middle = 0.5F * (low + high);
    double sum = 0.0;
    constexpr int kSteps = 2000;
    for (int k = 0; k < kSteps; ++k) {
      const float cos_angle = -1.0F + 2.0F * (static_cast<float>(k) + 0.5F) / kSteps;
      sum += std::min(aerosolPhase(cos_angle), middle) * 4.0 * kPi / kSteps;
    }
    (sum < 1.0 - kAerosolForwardPart ? low : high) = middle;
  }
  return low;
}

/// Legendre moments of a phase function, from degree 0 on.
template <typename Phase>
std::vector<double> legendreMoments(const Phase& phase, int degrees) {
  constexpr int kSteps = 4000;
  std::vector<double> moments(static_cast<std::size_t>(degrees), 0.0);
  for (int k = 0; k < kSteps; ++k) {
    const double cosine = -1.0 + 2.0 * (k + 0.5) / kSteps;
    const double part = static_cast<double>(phase(static_cast<float>(cosine))) * 4.0 * kPi / kSteps;
    double before = 0.0;
    double now = 1.0;
    for (int l = 0; l < degrees; ++l) {
      moments[static_cast<std::size_t>(l)] += part * now;
      const double next = ((2.0 * l + 1.0) * cosine * now - l * before) / (l + 1.0);
      before = now;
      now = next;
    }
  }
  return moments;
}

/// Light scattered n ≥ 2 times by the part of aerosolPhase() above aerosolWidePhase(). Each scattering
/// multiplies the Legendre moments, and n is distributed as along a path whose optical depth of that part is
/// kDepth, which is what a line of sight near the horizon has.
class PhaseTable {
 public:
  PhaseTable() {
    const std::vector<double> moments = momentsOfMany();
    for (int i = 0; i < kNodes; ++i) {
      const double x = static_cast<double>(i) / (kNodes - 1);
      const double cosine = 1.0 - 2.0 * x * x;
      double before = 1.0;
      double now = cosine;
      double sum = moments[0] + 3.0 * moments[1] * cosine;
      for (std::size_t l = 2; l < moments.size(); ++l) {
        const double degree = static_cast<double>(l);
        const double next = ((2.0 * degree - 1.0) * cosine * now - (degree - 1.0) * before) / degree;
        before = now;
        now = next;
        sum += (2.0 * degree + 1.0) * moments[l] * now;
      }
      values_[static_cast<std::size_t>(i)] = {aerosolPhase(static_cast<float>(cosine)),
                                              static_cast<float>(std::max(0.0, sum / (4.0 * kPi)))};
    }
  }
  AerosolPhases operator()(float cos_angle) const {
    const TablePlace place =
        placeAt(std::sqrt(std::max(0.0F, 0.5F * (1.0F - cos_angle))) * (kNodes - 1), kNodes);
    const AerosolPhases& low = values_[static_cast<std::size_t>(place.index)];
    const AerosolPhases& high = values_[static_cast<std::size_t>(place.index) + 1];
    return {low.once + (high.once - low.once) * place.fraction,
            low.again + (high.again - low.again) * place.fraction};
  }

 private:
  static constexpr int kNodes = 256;  // even in the sine of half the angle
  static constexpr double kDepth = 0.6;
  static std::vector<double> momentsOfMany() {
    std::vector<double> moments =
        legendreMoments([](float cosine) { return aerosolPhase(cosine) - aerosolWidePhase(cosine); }, 60);
    const double never = std::exp(-kDepth);
    const double once = never * kDepth;
    for (double& moment : moments) {
      const double one = moment / kAerosolForwardPart;
      moment = (std::exp(kDepth * (one - 1.0)) - never - once * one) / (1.0 - never - once);
    }
    return moments;
  }
  std::array<AerosolPhases, kNodes> values_ = {};
};

}  // namespace

Spectrum aerosolOpticalDepth(double turbidity) {
  Spectrum depth;
  for (int band = 0; band < kBands; ++band) {
    depth[band] = static_cast<float>(std::max(0.0, 0.04608 * turbidity - 0.04586) *
                                     std::pow(bandCentre_nm(band) * 1e-3, -1.3));
  }
  return depth;
}

float aerosolPhase(float cos_angle) {
  float sum = 0.0F;
  for (const Lobe& lobe : kAerosolLobes) {
    sum += lobe.weight * henyeyGreenstein(cos_angle, lobe.asymmetry);
  }
  return sum;
}

AerosolPhases aerosolPhases(float cos_angle) {
  static const PhaseTable table;
  return table(cos_angle);
}

float aerosolAgainPhase(float cos_angle) {
  return aerosolPhases(cos_angle).again;
}

float aerosolWidePhase(float cos_angle) {
  static const float limit = widePhaseLimit();
  return std::min(aerosolPhase(cos_angle), limit);
}

std::array<float, 5> aerosolWideMoments() {
  std::array<float, 5> moments;
  const std::vector<double> sums = legendreMoments(aerosolWidePhase, 5);
  std::transform(sums.begin(), sums.end(), moments.begin(), [](double m) { return static_cast<float>(m); });
  return moments;
}

Medium::Medium(const MediumParameters& parameters) : parameters_(parameters), densities_(kLayers + 1) {
  double air_column_km = 0.0;
  for (int i = 0; i <= kLayers; ++i) {
    const double altitude_km = i * kLayer_km;
    const double air = airDensity(altitude_km) / kAir[0].kg_per_m3;
    densities_[static_cast<std::size_t>(i)] = {
        static_cast<float>(air), static_cast<float>(std::exp(-altitude_km / kAerosolScaleHeight_km)),
        static_cast<float>(ozoneDensity(altitude_km))};
    air_column_km += air * kLayer_km * (i == 0 || i == kLayers ? 0.5 : 1.0);
  }
  constexpr double kMoleculesPerDobson_m2 = 2.6867e20;
  rayleigh_ = rayleighOpticalDepth() / static_cast<float>(air_column_km);
  aerosol_extinction_ =
      aerosolOpticalDepth(parameters.turbidity) / static_cast<float>(kAerosolScaleHeight_km);
  aerosol_scattering_ = aerosol_extinction_ * static_cast<float>(parameters.aerosol_albedo);
  ozone_ = (ozoneCrossSection_m2() * 1e25F) *
           static_cast<float>(parameters.ozone_du * kMoleculesPerDobson_m2 * 1e-25);
}

Medium::Layer Medium::layerAt(double altitude_km) const {
  const double x = std::clamp(altitude_km / kLayer_km, 0.0, static_cast<double>(kLayers));
  const auto i = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(kLayers - 1));
  return {densities_[i], densities_[i + 1], static_cast<float>(x - static_cast<double>(i))};
}

LocalMedium Medium::at(double altitude_km) const {
  const auto [a, b, t] = layerAt(altitude_km);
  LocalMedium local;
  local.rayleigh_scattering = rayleigh_ * (a.air + t * (b.air - a.air));
  const float aerosol = a.aerosol + t * (b.aerosol - a.aerosol);
  local.aerosol_scattering = aerosol_scattering_ * aerosol;
  local.extinction = local.rayleigh_scattering + aerosol_extinction_ * aerosol +
                     ozone_ * (a.ozone + t * (b.ozone - a.ozone));
  const Spectrum straight_ahead = local.aerosol_scattering * kAerosolForwardPart;
  local.scaled_extinction = local.extinction - straight_ahead;
  return local;
}

float Medium::aerosolDensity(double altitude_km) const {
  const auto [a, b, t] = layerAt(altitude_km);
  return a.aerosol + t * (b.aerosol - a.aerosol);
}

double Medium::refractivity(double altitude_km) const {
  const auto [a, b, t] = layerAt(altitude_km);
  return parameters_.refractivity * static_cast<double>(a.air + t * (b.air - a.air));
}

double Medium::refractionPerKm(double altitude_km) const {
  const auto [a, b, t] = layerAt(altitude_km);
  return parameters_.refractivity * static_cast<double>(b.air - a.air) / kLayer_km;
}

}  // namespace sunlit::sky
