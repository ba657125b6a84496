/// Samples in rooms look for light by more rays, and remember what they see: see BakedRooms.
#pragma once

#include "light/bake/gather/exchange.h"
#include "light/bake/gather/room_directions.h"
#include "light/bake/samples/scene_samples.h"
#include "light/bake/samples/transport_data.h"
#include "light/bake/samples/work_done.h"

namespace sunlit::light {

/// Makes BakedRooms, in parallel; the same bits for any number of threads. Keeps references.
class RoomBaker {
 public:
  RoomBaker(const BakeScene& scene, const SceneSamples& samples, const Exchange& exchange)
      : scene_(scene), samples_(samples), exchange_(exchange) {}

  /// Once `data` has direct light and tells what is hidden: finds the rooms and their links, and has these
  /// two known better there.
  void look(TransportData* data, const Progress& progress) const;
  /// Adds what it takes to follow sun and moon there, for all bounces, but for BakedRooms::mirrored.
  void finish(BakedRooms* rooms) const;

 private:
  struct View;
  class Looking;
  std::vector<std::uint32_t> lookers() const;
  std::vector<View> lookFrom(const std::uint32_t* lookers, std::size_t count,
                             const RoomDirections& sphere) const;
  void addSources(BakedRooms* rooms) const;
  void addPoints(BakedRooms* rooms) const;
  void addGlossy(BakedRooms* rooms) const;
  void dropHidden(const BakedRooms::Source& source, std::vector<BakedRooms::Point>* points) const;

  const BakeScene& scene_;
  const SceneSamples& samples_;
  const Exchange& exchange_;
};

}  // namespace sunlit::light
