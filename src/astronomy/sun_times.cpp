#include "sunlit/astronomy/sun_times.h"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "astronomy/observer.h"
#include "sunlit/astronomy/refraction.h"

namespace sunlit::astronomy {
namespace {

constexpr double kDay_s = 86400.0;
constexpr double kScanStep_s = 600.0;
constexpr double kResolution_s = 1e-3;

using Curve = std::function<double(double)>;  // of seconds since local midnight

struct Sample {
  double time_s;
  double value;
};

/// Where `curve` changes sign inside a bracket, by bisection: 20 steps from 10 min to below 1 ms.
double root(const Curve& curve, Sample low, Sample high) {
  while (high.time_s - low.time_s > kResolution_s) {
    const double middle_s = 0.5 * (low.time_s + high.time_s);
    const double value = curve(middle_s);
    ((value > 0.0) == (low.value > 0.0) ? low : high) = {middle_s, value};
  }
  return 0.5 * (low.time_s + high.time_s);
}

/// The highest point of `sign` · `curve` inside a bracket, by ternary search.
Sample extreme(const Curve& curve, double from_s, double to_s, double sign) {
  // An extreme is flat: 1 s beside it the elevation differs by less than 1e-6°.
  while (to_s - from_s > 1.0) {
    const double early_s = from_s + (to_s - from_s) / 3.0;
    const double late_s = to_s - (to_s - from_s) / 3.0;
    if (sign * curve(early_s) < sign * curve(late_s)) {
      from_s = early_s;
    } else {
      to_s = late_s;
    }
  }
  const double middle_s = 0.5 * (from_s + to_s);
  return {middle_s, curve(middle_s)};
}

/// The day in steps, with every extreme between them, so that the curve is monotonic from sample to sample
/// and a sun that only just shows itself is not stepped over.
std::vector<Sample> scan(const Curve& curve) {
  std::vector<Sample> steps;
  for (double time_s = -kScanStep_s; time_s <= kDay_s + kScanStep_s; time_s += kScanStep_s) {
    steps.push_back({time_s, curve(time_s)});
  }
  std::vector<Sample> samples;
  for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
    samples.push_back(steps[i]);
    const bool top = steps[i].value >= steps[i - 1].value && steps[i].value > steps[i + 1].value;
    const bool bottom = steps[i].value <= steps[i - 1].value && steps[i].value < steps[i + 1].value;
    if (!top && !bottom) continue;
    const Sample found = extreme(curve, steps[i - 1].time_s, steps[i + 1].time_s, top ? 1.0 : -1.0);
    if (found.time_s <= 0.0 || found.time_s >= kDay_s || found.time_s == steps[i].time_s) continue;
    samples.insert(found.time_s < steps[i].time_s ? samples.end() - 1 : samples.end(), found);
  }
  return samples;
}

Crossings crossings(const Curve& elevation_deg, const std::vector<Sample>& samples, double level_deg) {
  Crossings found;
  const Curve above = [&](double time_s) { return elevation_deg(time_s) - level_deg; };
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample low{samples[i - 1].time_s, samples[i - 1].value - level_deg};
    const Sample high{samples[i].time_s, samples[i].value - level_deg};
    if ((low.value > 0.0) == (high.value > 0.0)) continue;
    const bool rising = high.value > 0.0;
    if (rising && found.dawn) continue;
    (rising ? found.dawn : found.dusk) = root(above, low, high) / 3600.0;
  }
  return found;
}

}  // namespace

SunTimes sunTimes(const CivilDate& date, const Site& site, const Air& air, const EarthRotation& earth) {
  const Instant midnight = midnightOf(date);
  const Observer observer(site);
  const Air no_air{0.0, 0.0, Angle()};
  const auto position = [&](double time_s) {
    return sunPosition(solarCoordinates(midnight.plusSeconds(time_s), earth), observer, no_air);
  };
  const Curve elevation_deg = [&](double time_s) { return position(time_s).elevation_geometric.deg(); };
  const Curve hour_angle_deg = [&](double time_s) { return position(time_s).hour_angle.deg(); };
  const std::vector<Sample> samples = scan(elevation_deg);

  SunTimes times;
  times.horizon = crossings(elevation_deg, samples, horizonElevation(air).deg());
  times.civil = crossings(elevation_deg, samples, -6.0);
  times.nautical = crossings(elevation_deg, samples, -12.0);
  times.astronomical = crossings(elevation_deg, samples, -18.0);
  if (!times.horizon.dawn && !times.horizon.dusk) {
    const bool up = samples.front().value > horizonElevation(air).deg();
    times.state = up ? SunState::kPolarDay : SunState::kPolarNight;
  }
  // The hour angle grows by 15° an hour and jumps from 180° to −180° at midnight.
  for (double from_s = 0.0; from_s < kDay_s && !times.transit; from_s += kScanStep_s) {
    const Sample low{from_s, hour_angle_deg(from_s)};
    const Sample high{from_s + kScanStep_s, hour_angle_deg(from_s + kScanStep_s)};
    if (low.value <= 0.0 && high.value > 0.0 && high.value - low.value < 90.0) {
      times.transit = root(hour_angle_deg, low, high) / 3600.0;
    }
  }
  return times;
}

}  // namespace sunlit::astronomy
