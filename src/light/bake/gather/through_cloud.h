/// What of sun and moon comes to the places of a bake through gaps and clouds.
#pragma once

#include <cstddef>
#include <vector>

#include "light/bake/samples/transport_data.h"
#include "sunlit/light/geometry.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// Of one disc, by sample: sky::Daylight::throughCloud() there. Light that surfaces near a place pass on to
/// it went through the cloud over them, which is the one over the place: clouds are far larger.
class ThroughCloud {
 public:
  /// `disc` is of `day`. 1 everywhere without broken cloud, or where `geometry`, of which `data` is a bake,
  /// is null.
  ThroughCloud(const TransportData& data, const Geometry* geometry, const sky::Daylight& day,
               const sky::DiscLight& disc);

  float at(std::size_t sample) const { return shares_.empty() ? 1.0f : shares_[sample]; }

 private:
  std::vector<float> shares_;
};

/// Of both discs of a day.
struct DiscsThroughCloud {
  DiscsThroughCloud(const TransportData& data, const Geometry* geometry, const sky::Daylight& day)
      : sun(data, geometry, day, day.sun()), moon(data, geometry, day, day.moon()) {}
  ThroughCloud sun, moon;
};

}  // namespace sunlit::light
