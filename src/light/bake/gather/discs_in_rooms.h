/// Sun and moon by way of the surfaces that they really light.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "light/bake/gather/exchange.h"
#include "light/bake/gather/through_cloud.h"
#include "light/bake/samples/transport_data.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// What surfaces pass on of them in BakedRooms: by rays from the surfaces that are seen there to the discs,
/// and from surface to surface until it changes little. It starts from what the patches of the sky tell, and
/// where no room is, that stays.
class DiscsInRooms {
 public:
  /// Parallel; the same bits for any number of threads. Keeps a reference to `data`.
  DiscsInRooms(const TransportData& data, const sky::Daylight& day, const Visibility& visibility,
               const DiscsThroughCloud& through);

  /// Whether neither shines by more than leastDisc_lx(), or no room is to be followed; at() must not be asked
  /// then.
  bool none() const { return arrived_.empty(); }
  /// Illuminance of a room's sample by surfaces, lx; of those in BakedRooms::glossy but not straight from
  /// discs by way of polished floors, which pictures add: see GlintNodes.
  const Arrived& at(std::size_t room) const { return arrived_[room]; }

 private:
  void findAsked();
  void startFromPatches(const sky::DiscLight& disc, const ThroughCloud& through);
  void send();
  Arrived arriving(std::size_t room) const;
  double receive();

  const TransportData& data_;
  std::vector<std::uint32_t> asked_;    ///< samples whose light matters here: rooms and what they see
  std::vector<Eigen::Array3f> direct_;  ///< of each source: luminance × π by light straight from the discs
  std::vector<Eigen::Array3f> has_;     ///< of each sample that is asked: illuminance by surfaces, lx
  std::vector<Eigen::Array4f> sent_;    ///< of each sample: luminance × π, and 0, as processors read it
  std::vector<Eigen::Array3f> mirrored_;  ///< of each room: by way of the ground as a mirror, lx
  std::vector<Eigen::Array3f> glints_;    ///< of each room: by way of polished floors, lx
  std::vector<Arrived> arrived_;          ///< of each room
};

}  // namespace sunlit::light
