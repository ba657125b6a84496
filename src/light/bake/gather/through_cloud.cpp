#include "light/bake/gather/through_cloud.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace sunlit::light {

ThroughCloud::ThroughCloud(const TransportData& data, const Geometry* geometry, const sky::Daylight& day,
                           const sky::DiscLight& disc) {
  const bool shines = disc.illuminance.value.maxCoeff() > 0.0f;
  if (geometry == nullptr || !shines || !day.hasBrokenCloud()) return;
  const std::vector<Eigen::Vector3f>& places = data.places(*geometry);
  shares_.resize(places.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), 4096),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i)
                        shares_[i] = day.throughCloud(disc, places[i]);
                    });
}

}  // namespace sunlit::light
