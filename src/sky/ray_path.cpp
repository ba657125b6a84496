#include "ray_path.h"

namespace sunlit::sky {
namespace {

/// Distances along a ray. The air is densest at `dense_km`, which is one of the others.
struct Stretch {
  double from_km, to_km, dense_km;
};

/// Edges that part a stretch, the closer the denser the air.
void addEdges(const Stretch& stretch, int count, std::vector<double>* edges_km) {
  for (int i = 1; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    const double part = stretch.dense_km == stretch.from_km ? t * t : 1.0 - (1.0 - t) * (1.0 - t);
    edges_km->push_back(stretch.from_km + (stretch.to_km - stretch.from_km) * part);
  }
}

}  // namespace

bool hitsGround(const Medium& medium, double altitude_km, double cos_zenith) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cos_zenith * cos_zenith));
  const double here = (1.0 + medium.refractivity(altitude_km)) * (kEarthRadius_km + altitude_km) * sine;
  return cos_zenith < 0.0 && here <= (1.0 + medium.refractivity(0.0)) * kEarthRadius_km;
}

std::vector<double> sightEdges(const Medium& medium, double altitude_km, double cos_zenith, int count) {
  std::vector<double> edges_km = {0.0};
  const Segment path = segment(altitude_km, cos_zenith);
  const double lowest_km = -(kEarthRadius_km + altitude_km) * cos_zenith;
  if (cos_zenith >= 0.0) {
    addEdges({0.0, path.length_km, 0.0}, count, &edges_km);
  } else if (hitsGround(medium, altitude_km, cos_zenith)) {
    // A bent ray that just hits would, if straight, just miss: there it ends near its lowest place.
    const double end_km = path.hits_ground ? path.length_km : lowest_km;
    addEdges({0.0, end_km, end_km}, count, &edges_km);
  } else {
    const double low_km = std::min(lowest_km, path.length_km);
    addEdges({0.0, low_km, low_km}, count / 2, &edges_km);
    // A straight ray that would hit is bent past the ground and goes on as far again as it came.
    const double length_km = path.hits_ground ? lowest_km + segment(0.0, 0.0).length_km : path.length_km;
    addEdges({low_km, length_km, low_km}, count / 2, &edges_km);
  }
  return edges_km;
}

}  // namespace sunlit::sky
