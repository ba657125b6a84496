#include "light/bake/gather/floor_glints.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "light/geometry/ray_list.h"
#include "light/shading/ggx.h"
#include "light/shading/polished_floor.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kRoomsOfTask = 64;
/// Rays of a room: the rest only where one of the first arrives.
constexpr std::uint32_t kProbes = 16, kAll = 96;

}  // namespace

FloorGlints::FloorGlints(const TransportData& data, const sky::DiscLight& disc, const Visibility& visibility,
                         const ThroughCloud& through)
    : data_(data),
      visibility_(visibility),
      through_(through),
      disc_(disc),
      illuminance_(disc.illuminance.value),
      vertices_(visibility.fixedGeometry(), visibility.movingGeometry()),
      glass_(visibility) {}

void FloorGlints::addTo(std::vector<Eigen::Array3f>* rooms) const {
  const image::KeptArray<BakedRooms::Glossy>& glossy = data_.rooms.glossy;
  tbb::parallel_for(
      std::size_t{0}, (glossy.size() + kRoomsOfTask - 1) / kRoomsOfTask, [&](std::size_t block) {
        const std::size_t first = block * kRoomsOfTask, end = std::min(glossy.size(), first + kRoomsOfTask);
        std::vector<Way> ways;
        std::vector<Sum> sums(end - first);
        for (std::size_t g = first; g < end; ++g)
          addWays(g, {static_cast<std::uint32_t>(g - first), 0, kProbes}, &ways);
        follow(ways, sums.data());
        ways.clear();
        for (std::size_t g = first; g < end; ++g) {
          if (sums[g - first].light.maxCoeff() > 0.0f)
            addWays(g, {static_cast<std::uint32_t>(g - first), kProbes, kAll}, &ways);
        }
        follow(ways, sums.data());
        for (std::size_t g = first; g < end; ++g) {
          const Sum& sum = sums[g - first];
          const std::uint32_t room = glossy[g].room;
          if (sum.areas > 0.0f)
            (*rooms)[room] += sum.light * illuminance_ / sum.areas * through_.at(data_.rooms.samples[room]);
        }
      });
}

void FloorGlints::addWays(std::size_t glossy, const Turn& turn, std::vector<Way>* ways) const {
  const BakedRooms::Source& source = data_.rooms.sources[data_.rooms.glossy[glossy].source];
  const Eigen::Vector3f normal = Eigen::Map<const Eigen::Vector3f>(source.normal.data());
  const auto facets = Ggx<float>::ofRoughness(data_.rooms.glossy[glossy].roughness);
  // The same facets for all: what chance does to one would be seen beside the next.
  static const EvenPoints even(0);
  for (std::uint32_t k = turn.first; k < turn.end; ++k) {
    const auto at_point = static_cast<std::uint32_t>(even.at(k, 4) * static_cast<float>(source.points));
    const BakedRooms::Point& point =
        data_.rooms.points[source.first_point + std::min(at_point, source.points - 1)];
    const Eigen::Vector3f to_disc = disc_.point(even.at(k, 0), even.at(k, 1));
    const Eigen::Vector3f facet = facets.normal(even.at(k, 2), even.at(k, 3));
    const float cosine = facet.dot(to_disc);
    const Eigen::Vector3f to_floor = -mirrored(to_disc, facet).normalized();
    Way way{turn.number, {point.x, point.y, point.z}, to_floor, to_disc, cosine, 0.0f, point.share};
    const float falls = normal.dot(to_floor), rises = -to_floor.z();
    // What is chosen with the density D n_h, seen along the mirrored way: Walter et al. 2007, eq. 20 and 14.
    if (cosine > 0.0f && falls > 0.0f && rises > 0.0f && to_disc.z() > 0.0f)
      way.factor = 4.0f * to_disc.z() * facets.visibility(to_disc.z(), rises) * cosine / facet.z() * falls;
    ways->push_back(way);
  }
}

void FloorGlints::follow(const std::vector<Way>& ways, Sum* sums) const {
  thread_local RayList down, up;
  thread_local std::vector<Hit> hits;
  thread_local std::vector<std::uint8_t> blocked;
  down.clear();
  up.clear();
  down.reserve(ways.size());
  for (std::uint32_t i = 0; i < ways.size(); ++i) {
    sums[ways[i].glossy].areas += ways[i].area;
    if (ways[i].factor > 0.0f) down.add(i, ways[i].origin, ways[i].to_floor);
  }
  hits.resize(down.size());
  visibility_.closest(down.rays(), hits.data());
  std::vector<Eigen::Array3f> light;
  up.reserve(down.size());
  for (std::size_t k = 0; k < down.size(); ++k) {
    const Way& way = ways[down.number()[k]];
    if (hits[k].triangle == Hit::kMiss) continue;
    const Vertex floor = vertices_.at(hits[k], way.to_floor);
    if (!isPolishedFloor(floor)) continue;
    Eigen::Array3f part = way.factor * way.area * mirroredShare(floor, way.cosine);
    if (glass_.any()) {
      part *= glass_.through({way.origin, way.to_floor, 0.0f, hits[k].distance}) *
              glass_.through({floor.front, way.to_disc, 0.0f, std::numeric_limits<float>::infinity()});
    }
    up.add(way.glossy, floor.front, way.to_disc);
    light.push_back(part);
  }
  blocked.resize(up.size());
  visibility_.occluded(up.rays(), blocked.data());
  for (std::size_t k = 0; k < up.size(); ++k)
    if (blocked[k] == 0) sums[up.number()[k]].light += light[k];
}

}  // namespace sunlit::light
