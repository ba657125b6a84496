/// What of sun and moon comes to the places of a bake through gaps and clouds.
#pragma once

#include <cstddef>
#include <vector>

#include "light/bake/samples/transport_data.h"
#include "sunlit/light/geometry.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// By sample: sky::Daylight::throughCloud() there. Light that surfaces near a place pass on to it went
/// through the cloud over them, which is the one over the place: clouds are far larger.
class ThroughCloud {
 public:
  /// 1 everywhere without broken cloud, or where `geometry`, of which `data` is a bake, is null.
  ThroughCloud(const TransportData& data, const Geometry* geometry, const sky::Daylight& day);

  float sun(std::size_t sample) const { return sun_.empty() ? 1.0f : sun_[sample]; }
  float moon(std::size_t sample) const { return moon_.empty() ? 1.0f : moon_[sample]; }
  /// Of that disc of the day.
  float of(const sky::DiscLight& disc, std::size_t sample) const {
    return &disc == sun_disc_ ? sun(sample) : moon(sample);
  }

 private:
  const sky::DiscLight* sun_disc_;
  std::vector<float> sun_, moon_;
};

}  // namespace sunlit::light
