#include "sunlit/sky/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "sky_table.h"

namespace sunlit::sky {
namespace {

void requireWithin(const char* key, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    std::ostringstream message;
    message << key << ": " << value << " is outside " << low << " … " << high;
    throw std::invalid_argument(message.str());
  }
}

/// The disc in level slices: each is dimmed by its own air, and the horizon cuts it off.
Spectrum sunlightAtGround(const Transport& transport, double altitude_km, double elevation_rad,
                          double radius_rad) {
  constexpr int kSlices = 16;
  Spectrum sum = Spectrum::Zero();
  double area = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double height = 2.0 * (i + 0.5) / kSlices - 1.0;
    const double share = std::sqrt(1.0 - height * height);
    area += share;
    const double low = elevation_rad + radius_rad * (height - 1.0 / kSlices);
    const double high = elevation_rad + radius_rad * (height + 1.0 / kSlices);
    const double above = std::clamp(high / (high - low), 0.0, 1.0);
    if (above > 0.0) {
      const double middle = std::min(0.5 * (std::max(low, 0.0) + high), 0.5 * kPi);
      sum += transport.transmittance(altitude_km, std::sin(middle)) * static_cast<float>(share * above);
    }
  }
  return sum / static_cast<float>(area);
}

}  // namespace

struct Atmosphere::Tables {
  AtmosphereOptions options;
  Transport transport;
};

void validate(const AtmosphereOptions& options) {
  requireWithin("turbidity", options.turbidity, 1.0, 10.0);
  requireWithin("ground_albedo", options.ground_albedo, 0.0, 1.0);
  requireWithin("observer_height_m", options.observer_height_m, 0.0, 8000.0);
}

Atmosphere::Atmosphere(const AtmosphereOptions& options) {
  validate(options);
  MediumParameters parameters;
  parameters.turbidity = options.turbidity;
  parameters.ground_albedo = options.ground_albedo;
  tables_.reset(new Tables{options, Transport(parameters)});
}

Atmosphere::~Atmosphere() = default;
Atmosphere::Atmosphere(Atmosphere&&) noexcept = default;
Atmosphere& Atmosphere::operator=(Atmosphere&&) noexcept = default;

Daylight Atmosphere::daylight(const SunInSky& sun, const NightSky&) const {
  requireWithin("distance_au", sun.distance_au, 0.97, 1.03);
  const double altitude_km = tables_->options.observer_height_m * 1e-3;
  DiscLight disc;
  disc.towards = sun.apparent;
  disc.angular_radius = Angle::radians(std::asin(sin(kSunRadiusAtOneAu) / sun.distance_au));
  const Spectrum arriving = sunlightAtGround(tables_->transport, altitude_km, sun.apparent.elevation().rad(),
                                             disc.angular_radius.rad());
  disc.illuminance =
      inGamut(colourOf(arriving * static_cast<float>(1.0 / (sun.distance_au * sun.distance_au))));
  const SkyScene scene{altitude_km, disc, sun.geometric.value_or(sun.apparent), sun.distance_au};
  return Daylight(std::make_shared<SkyTable>(makeSkyTable(tables_->transport, scene)));
}

}  // namespace sunlit::sky
