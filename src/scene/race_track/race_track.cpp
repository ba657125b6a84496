#include "sunlit/scene/race_track.h"

#include <cmath>

#include "scene/race_track/assembly.h"
#include "scene/race_track/barriers.h"
#include "scene/race_track/buildings.h"
#include "scene/race_track/course.h"
#include "scene/race_track/furniture.h"
#include "scene/race_track/grandstand.h"
#include "scene/race_track/ground.h"
#include "scene/race_track/plants.h"
#include "scene/race_track/road.h"

namespace sunlit::scene {

Scene raceTrack() {
  race_track::Assembly assembly;
  race_track::addLand(assembly);
  race_track::addRoad(assembly);
  race_track::addBarriers(assembly);
  race_track::addBuildings(assembly);
  race_track::addGrandstands(assembly);
  race_track::addFurniture(assembly);
  race_track::addBridges(assembly);
  race_track::addPaddocks(assembly);
  const race_track::Foliage foliage = race_track::paintFoliage(assembly);
  race_track::addTrees(assembly, foliage);
  race_track::addForest(assembly, foliage);
  race_track::addGrass(assembly, foliage);
  race_track::addStones(assembly);
  return assembly.finish("race_track");
}

std::vector<Eigen::Vector3d> raceTrackWaypoints() {
  using race_track::course;
  using race_track::TrackPlace;
  // 123 segments of 8 poses and one of 7: the paper's rule gives a segment as many poses as its length in
  // metres, rounded up. The lengths stay clear of whole metres, so that rounding decides nothing.
  constexpr int kSegments = 124;
  constexpr double kSegment_m = 7.9;
  constexpr double kLastSegment_m = 6.9;
  const auto drive = [](double along) { return course().point({along, course().drivingLine(along)}); };
  double along = -26.0;
  Eigen::Vector2d here = drive(along);
  std::vector<Eigen::Vector3d> waypoints;
  for (int i = 0;; ++i) {
    const double height = race_track::groundHeight(course().nearest(here));
    waypoints.emplace_back(here.x(), here.y(), height);
    if (i == kSegments) break;
    const double wanted = i + 1 == kSegments ? kLastSegment_m : kSegment_m;
    double low = along;
    double high = along + 1.5 * wanted;
    while (high - low > 1e-9) {
      const double middle = 0.5 * (low + high);
      ((drive(middle) - here).norm() < wanted ? low : high) = middle;
    }
    along = low;
    here = drive(along);
  }
  return waypoints;
}

}  // namespace sunlit::scene
