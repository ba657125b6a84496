// Who is seen from rooms, and where sun and moon may shine on them.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <vector>

#include "light/bake/gather/rooms.h"
#include "light/bake/samples/mesh_leaves.h"
#include "light/bake/samples/met_sample.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

/// The part of a leaf that is nearest to one of its corners.
struct LeafPart {
  const Eigen::Matrix3f& corners;  ///< of the leaf, m in `map`
  std::size_t nearest;             ///< of them
  const Eigen::Vector3f& face;     ///< its normal, to the side that is lit
  bool finely;                     ///< to be looked at
  std::uint64_t key;               ///< of chance
};

/// Scattered over the part, for edges of shadows may run along any rows. Their shares are areas, m².
void addPart(const LeafPart& part, std::vector<BakedRooms::Point>* points) {
  constexpr float kEach_m2 = 0.01f;
  constexpr float kMostOfPart = 24.0f;
  constexpr int kCoarsely = 2;
  const Eigen::Vector3f own = part.corners.col(static_cast<Eigen::Index>(part.nearest));
  const Eigen::Vector3f one = part.corners.col(static_cast<Eigen::Index>((part.nearest + 1) % 3)) - own;
  const Eigen::Vector3f two = part.corners.col(static_cast<Eigen::Index>((part.nearest + 2) % 3)) - own;
  const float part_m2 = one.cross(two).norm() / 6.0f;
  // Clamped before it is a whole number, which a large part has no room in.
  const int count =
      part.finely ? static_cast<int>(std::clamp(part_m2 / kEach_m2, 1.0f, kMostOfPart)) : kCoarsely;
  const EvenPoints even(part.key);
  for (int i = 0; i < count; ++i) {
    // In a parallelogram, folded to the half that lies at the corner: one of the two triangles that meet in
    // the middle of the leaf.
    float u = even.at(static_cast<std::uint32_t>(i), 0), v = even.at(static_cast<std::uint32_t>(i), 1);
    if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
    const Eigen::Vector3f edge = 0.5f * (i % 2 == 0 ? one : two), middle = (one + two) / 3.0f;
    const Eigen::Vector3f point = own + u * edge + v * middle;
    const Eigen::Vector3f clear = point + rayClearance_m(point, 0.0f) * part.face;
    points->push_back({clear.x(), clear.y(), clear.z(), part_m2 / static_cast<float>(count)});
  }
}

// What is no room itself, such as the ground before a window, mostly lies in the sun as a whole, or not.
constexpr std::uint32_t kMostOfRooms = 144, kMostOfOthers = 12;  ///< points of a source
constexpr std::uint32_t kProbesOfRooms = 32, kProbesOfOthers = 4;

/// Adds at most `most` of a source's points.
void addSome(const std::vector<BakedRooms::Point>& points, std::uint32_t most, std::size_t number,
             BakedRooms* rooms) {
  const auto has = static_cast<std::uint32_t>(points.size()), kept = std::min(has, most);
  float all = 0.0f;
  for (std::uint32_t k = 0; k < kept; ++k) all += points[k * has / kept].share;
  if (!(all > 0.0f)) return;
  BakedRooms::Source& source = rooms->sources[number];
  source.first_point = static_cast<std::uint32_t>(rooms->points.size());
  source.points = kept;
  source.probes = std::min(kept, most == kMostOfRooms ? kProbesOfRooms : kProbesOfOthers);
  for (std::uint32_t k = 0; k < kept; ++k) {
    rooms->points.push_back(points[k * has / kept]);
    rooms->points.back().share /= all;
  }
}

std::array<float, 3> stored(const Eigen::Array3f& rgb) {
  return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace

void RoomBaker::finish(BakedRooms* rooms) const {
  addSources(rooms);
  addPoints(rooms);
  addGlossy(rooms);
}

void RoomBaker::addSources(BakedRooms* rooms) const {
  std::vector<bool> seen(samples_.receivers.size(), false);
  for (const BakedRooms::Link link : rooms->links) seen[link.sample()] = true;
  for (std::uint32_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) continue;
    const Sending sends = exchange_.sendingToRooms(i);
    rooms->sources.push_back({i, sends.other, stored(sends.direct), stored(sends.bounced),
                              stored(sends.through), stored(samples_.receivers[i].normal.array()), 0, 0, 0});
  }
}

void RoomBaker::addPoints(BakedRooms* rooms) const {
  std::vector<std::uint32_t> source_of(samples_.receivers.size(), LightMesh::kNone);
  std::vector<std::uint32_t> most(rooms->sources.size(), kMostOfOthers);
  for (std::uint32_t s = 0; s < rooms->sources.size(); ++s) {
    const BakedRooms::Source& source = rooms->sources[s];
    const Receiver& receiver = samples_.receivers[source.sample];
    const bool card = samples_.other_side[source.sample].shares_rays;
    if (!card && !receiver.coarse && !receiver.thin) source_of[source.sample] = s;
    if (std::binary_search(rooms->samples.begin(), rooms->samples.end(), source.sample))
      most[s] = kMostOfRooms;
  }
  std::vector<std::vector<BakedRooms::Point>> points(rooms->sources.size());
  for (std::uint32_t t = 0; t < samples_.mesh.roots.size(); ++t) {
    const auto& v = scene_.geometry.triangles[t];
    Eigen::Matrix3f at;
    for (Eigen::Index k = 0; k < 3; ++k)
      at.col(k) = scene_.geometry.positions[v[static_cast<std::size_t>(k)]];
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t root = samples_.mesh.roots[t][static_cast<std::size_t>(side)];
      if (!LightMesh::isCell(root)) continue;
      const Eigen::Vector3f face = sideNormal(scene_.geometry, t, side);
      const auto addLeaf = [&](const LightMesh::Cell& cell, const Eigen::Matrix3f& within) {
        const Eigen::Matrix3f corners = at * within;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t s = source_of[samples_.nearest_sample[cell.corner[k]]];
          if (s == LightMesh::kNone) continue;
          const std::uint64_t key = std::uint64_t{s} << 32 | points[s].size();
          addPart({corners, k, face, most[s] == kMostOfRooms, key}, &points[s]);
        }
      };
      visitLeaves(samples_.mesh, root, Eigen::Matrix3f::Identity(), addLeaf);
    }
  }
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t s) { dropHidden(rooms->sources[s], &points[s]); });
  for (std::size_t s = 0; s < points.size(); ++s) {
    addSome(points[s], most[s], s, rooms);
    std::vector<BakedRooms::Point>().swap(points[s]);
  }
}

void RoomBaker::addGlossy(BakedRooms* rooms) const {
  std::vector<char> polished(samples_.receivers.size());
  for (std::uint32_t i = 0; i < polished.size(); ++i) polished[i] = exchange_.isPolished(i) ? 1 : 0;
  if (std::find(polished.begin(), polished.end(), 1) == polished.end()) return;
  for (std::uint32_t room = 0; room < rooms->samples.size(); ++room) {
    float weights = 0.0f, roughness = 0.0f;
    visitLinks(*rooms, room, [&](const SampleSeen& other, bool) {
      if (polished[other.sample] == 0) return;
      weights += other.weight;
      roughness += other.weight * samples_.paints[other.sample].roughness;
    });
    if (!(weights > 0.0f)) continue;
    const auto source = std::lower_bound(
        rooms->sources.begin(), rooms->sources.end(), rooms->samples[room],
        [](const BakedRooms::Source& other, std::uint32_t sample) { return other.sample < sample; });
    if (source == rooms->sources.end() || source->sample != rooms->samples[room] || source->points == 0)
      continue;
    rooms->glossy.push_back(
        {room, static_cast<std::uint32_t>(source - rooms->sources.begin()), roughness / weights});
  }
}

/// A floor goes on below the wall that stands on it: what lies there is of no room.
void RoomBaker::dropHidden(const BakedRooms::Source& source, std::vector<BakedRooms::Point>* points) const {
  const Eigen::Vector3f away = Eigen::Map<const Eigen::Vector3f>(source.normal.data());
  std::vector<BakedRooms::Point> open;
  RayPacket rays;
  HitPacket hits;
  for (std::size_t first = 0; first < points->size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, points->size() - first);
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      const BakedRooms::Point& point = (*points)[first + std::min(lane, count - 1)];
      rays.set(lane, {point.x, point.y, point.z}, away, lane < count);
    }
    scene_.rays.cast(rays, &hits);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const bool free = hits.triangle[lane] == HitPacket::kNothing;
      if (free || hasSampleAt(scene_, samples_, {hits, static_cast<int>(lane), away}))
        open.push_back((*points)[first + lane]);
    }
  }
  points->swap(open);
}

}  // namespace sunlit::light
