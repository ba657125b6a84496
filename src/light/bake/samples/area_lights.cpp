#include "light/bake/samples/area_lights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

/// See AreaLights::facing().
constexpr int kFacings = 24;

}  // namespace

AreaLights::AreaLights(const BakeRays& rays, std::vector<Piece> pieces)
    : rays_(rays), pieces_(std::move(pieces)) {
  pieces_.erase(std::remove_if(pieces_.begin(), pieces_.end(),
                               [](const Piece& piece) { return !(piece.power() > 0.0f); }),
                pieces_.end());
  // What shines to both sides has no front: that of its opposite is as good.
  for (Piece& piece : pieces_)
    if (piece.both && facing(piece) >= kFacings / 2) piece.normal = -piece.normal;
  if (any()) build();
}

float AreaLights::Piece::power() const {
  return LinearRgb(luminance).luminance() * area_m2();
}

/// Which share of all directions its normal is in, a third of an octant: of what faces alike nearly all, or
/// nearly nothing, is seen from a place. Opposite ones are half of all apart.
int AreaLights::facing(const Piece& piece) {
  Eigen::Index axis = 0;
  piece.normal.cwiseAbs().maxCoeff(&axis);
  const bool back = piece.normal[axis] < 0.0f;
  const auto isBack = [&](Eigen::Index other) { return piece.normal[(axis + other) % 3] < 0.0f; };
  // Of the opposite, all are the other way round.
  const int quadrant = (isBack(1) != back ? 2 : 0) + (isBack(2) != back ? 1 : 0);
  return (back ? kFacings / 2 : 0) + static_cast<int>(axis) * 4 + quadrant;
}

void AreaLights::build() {
  const auto kind = [](const Piece& piece) { return facing(piece) + (piece.both ? kFacings : 0); };
  std::stable_sort(pieces_.begin(), pieces_.end(),
                   [&](const Piece& a, const Piece& b) { return kind(a) < kind(b); });
  for (std::uint32_t first = 0, end = 0; end < pieces_.size(); first = end) {
    while (end < pieces_.size() && kind(pieces_[end]) == kind(pieces_[first])) ++end;
    roots_.push_back(static_cast<std::uint32_t>(clusters_.size()));
    build(first, end);
  }
}

void AreaLights::build(std::uint32_t first, std::uint32_t end) {
  const std::size_t own = clusters_.size();
  Cluster cluster;
  cluster.first = first;
  cluster.end = end;
  Eigen::AlignedBox3f middles;
  for (std::uint32_t i = first; i < end; ++i) {
    cluster.box.extend(pieces_[i].box());
    middles.extend(pieces_[i].middle());
    const Piece& piece = pieces_[i];
    const float power = piece.power();
    cluster.power += power;
    cluster.intensity += piece.area_m2() * piece.luminance;
    cluster.middle += power * piece.middle();
    cluster.facing += power * piece.normal;
    cluster.lamp_m += power * piece.lamp_m;
    cluster.least_lamp_m = std::min(cluster.least_lamp_m, piece.lamp_m);
  }
  cluster.radius_m = 0.5f * cluster.box.diagonal().norm();
  cluster.both = pieces_[first].both;
  cluster.middle /= cluster.power;
  cluster.facing /= cluster.power;
  cluster.lamp_m /= cluster.power;
  for (std::uint32_t i = first; i < end; ++i)
    cluster.spread =
        std::max(cluster.spread, pieces_[i].normal.cross(cluster.facing).norm() / cluster.facing.norm());
  clusters_.push_back(cluster);
  if (end - first == 1) {
    powers_.push_back((powers_.empty() ? 0.0 : powers_.back()) + static_cast<double>(cluster.power));
    return;
  }
  Eigen::Index axis = 0;
  middles.diagonal().maxCoeff(&axis);
  const std::uint32_t half = first + (end - first) / 2;
  std::nth_element(pieces_.begin() + first, pieces_.begin() + half, pieces_.begin() + end,
                   [axis](const Piece& a, const Piece& b) { return a.middle()[axis] < b.middle()[axis]; });
  build(first, half);
  clusters_[own].second = static_cast<std::uint32_t>(clusters_.size());
  build(half, end);
}

float AreaLights::distance_m(const Eigen::AlignedBox3f& box, float most_m) const {
  float nearest_m = most_m;
  for (const std::uint32_t root : roots_) nearest(root, box, &nearest_m);
  return nearest_m;
}

void AreaLights::nearest(std::uint32_t number, const Eigen::AlignedBox3f& box, float* nearest_m) const {
  const Cluster& cluster = clusters_[number];
  const float distance_m = cluster.box.exteriorDistance(box);
  if (distance_m >= *nearest_m) return;
  if (cluster.second == 0) {
    *nearest_m = distance_m;
    return;
  }
  nearest(number + 1, box, nearest_m);
  nearest(cluster.second, box, nearest_m);
}

}  // namespace sunlit::light
