// What a place gets of surfaces that shine.
#include <algorithm>
#include <cmath>
#include <optional>

#include "light/bake/samples/shining_surfaces.h"
#include "sunlit/quantity/photometry.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

/// Of the distance: as wide as clusters may be.
constexpr float kWidest = 0.25f;
/// Sine of angles between normals of a cluster and their mean that make no difference.
constexpr float kAlike = 0.15f;
/// Of all that a place would get: of what gives less, some are asked for and count for more.
constexpr float kSmall = 0.002f;
/// Of the distance: as long as pieces may be before they are halved, and how often that is done at most.
constexpr float kLongest = 0.5f;
constexpr int kMostHalved = 20;
/// Of a place, as far as kMostRays to each part allow.
constexpr std::size_t kRays = 32, kMostRays = 8;

using Triangle = std::array<Eigen::Vector3f, 3>;

float longestEdge(const Triangle& corner) {
  return std::max(
      {(corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(), (corner[0] - corner[2]).norm()});
}

}  // namespace

/// Illuminance, lx per cd/m², of a plane at `point` with the unit normal `normal` by a triangle that shines
/// evenly and all of which is seen: the polygon formula of Lambert (1760), of the part before the plane.
float ShiningSurfaces::formFactor(const Piece& piece, const Eigen::Vector3f& point,
                                  const Eigen::Vector3f& normal) {
  std::array<Eigen::Vector3f, 4> polygon;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3f a = piece.corner[k] - point, b = piece.corner[(k + 1) % 3] - point;
    const float high_a = a.dot(normal), high_b = b.dot(normal);
    if (high_a >= 0.0f) polygon[count++] = a;
    if ((high_a < 0.0f) != (high_b < 0.0f)) polygon[count++] = a + high_a / (high_a - high_b) * (b - a);
  }
  if (count < 3) return 0.0f;
  float sum = 0.0f;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector3f &a = polygon[k], &b = polygon[(k + 1) % count];
    const Eigen::Vector3f cross = a.cross(b);
    const float sine = cross.norm();
    if (sine > 0.0f) sum += std::atan2(sine, a.dot(b)) * cross.dot(normal) / sine;
  }
  return 0.5f * std::abs(sum);
}

/// A piece of a cluster, by its power; `chance` in [0, 1).
const ShiningSurfaces::Piece& ShiningSurfaces::pick(const Cluster& cluster, float chance) const {
  const double before = cluster.first > 0 ? powers_[cluster.first - 1] : 0.0;
  const double sought = before + static_cast<double>(chance) * (powers_[cluster.end - 1] - before);
  const auto found =
      std::upper_bound(powers_.begin() + cluster.first, powers_.begin() + cluster.end - 1, sought);
  return pieces_[static_cast<std::size_t>(found - powers_.begin())];
}

/// From one place.
class ShiningSurfaces::Look {
 public:
  Look(const ShiningSurfaces& sources, const Receiver& receiver, std::uint64_t key)
      : sources_(sources), receiver_(receiver), key_(scrambled(key)) {
    // Clear of the surface, lest one that shines lights itself.
    for (std::size_t k = 0; k < Receiver::kOrigins; ++k)
      middle_ += (receiver.origins[k] + receiver.lifts[k]) / Receiver::kOrigins;
  }

  Light all() {
    for (const std::uint32_t root : sources_.roots_) gather(root);
    float sum = 0.0f, over_distance = 0.0f;
    for (const Asked& asked : asked_) {
      sum += asked.size;
      over_distance += asked.size / std::max(asked.distance_m, 1e-3f);
    }
    if (!(sum > 0.0f)) return light_;
    light_.distance_m = sum / over_distance;
    passed_over_ = chance() * kSmall * sum;
    const std::size_t rays = std::clamp<std::size_t>(kRays / asked_.size(), 1, kMostRays);
    for (const Asked& asked : asked_) aim(asked, kSmall * sum, rays);
    cast();
    return light_;
  }

 private:
  /// What shines, and what it gives if it is seen.
  struct Asked {
    const Cluster* cluster;          ///< of more than one piece, or null:
    std::optional<Triangle> corner;  ///< of one, or a part of it
    float distance_m;
    float side;            ///< of the receiver, 1 or −1: before or behind its normal
    Eigen::Array3f light;  ///< lx
    float size;            ///< luminance of it
  };
  float chance() { return uniform(key_, drawn_++); }

  void gather(std::uint32_t number) {
    const Cluster& cluster = sources_.clusters_[number];
    if (cluster.second != 0 && (isWide(cluster) || isSeenInPart(cluster))) {
      gather(number + 1);
      gather(cluster.second);
      return;
    }
    const Piece& piece = sources_.pieces_[cluster.first];
    if (cluster.second != 0) {
      askFar(cluster, piece.both);
    } else if (isSeen(piece)) {
      ask(piece, 0);
    }
  }

  bool isWide(const Cluster& cluster) const {
    return cluster.box.diagonal().norm() > kWidest * cluster.box.exteriorDistance(middle_);
  }

  /// Whether some of its pieces face the place and others do not.
  bool isSeenInPart(const Cluster& cluster) const {
    if (cluster.spread < kAlike) return false;
    const Eigen::Vector3f way = cluster.middle - middle_;
    return std::abs(cluster.facing.dot(way)) < cluster.spread * cluster.facing.norm() * way.norm();
  }

  bool isSeen(const Piece& piece) const {
    return piece.both || piece.normal.dot(middle_ - piece.corner[0]) > 0.0f;
  }

  /// As a point whose intensity is the sum over its pieces, each by its cosine.
  void askFar(const Cluster& cluster, bool both) {
    const Eigen::Vector3f way = cluster.middle - middle_;
    const float distance_m = way.norm(), before = -cluster.facing.dot(way) / distance_m;
    const float seen = both ? std::abs(before) : std::max(before, 0.0f);
    forEachSide([&](float side, float share) {
      const float cosine = std::max(side * receiver_.normal.dot(way) / distance_m, 0.0f);
      const Eigen::Array3f light = cluster.intensity * (share * seen * cosine / (distance_m * distance_m));
      add({&cluster, std::nullopt, distance_m, side, light, 0.0f});
    });
  }

  /// Asks for a piece, or for its halves.
  void ask(const Piece& piece, int halved) {
    if (longestEdge(piece.corner) > kLongest * piece.box().exteriorDistance(middle_) &&
        halved < kMostHalved) {
      std::size_t from = 0;
      float longest = 0.0f;
      for (std::size_t k = 0; k < 3; ++k) {
        const float edge = (piece.corner[k] - piece.corner[(k + 1) % 3]).squaredNorm();
        if (edge > longest) longest = edge, from = k;
      }
      const std::size_t to = (from + 1) % 3;
      const Eigen::Vector3f between = 0.5f * (piece.corner[from] + piece.corner[to]);
      for (const std::size_t moved : {from, to}) {
        Piece half = piece;
        half.corner[moved] = between;
        ask(half, halved + 1);
      }
      return;
    }
    const float distance_m = (piece.middle() - middle_).norm();
    forEachSide([&](float side, float share) {
      const float factor = share * formFactor(piece, middle_, side * receiver_.normal);
      add({nullptr, piece.corner, distance_m, side, piece.luminance * factor, 0.0f});
    });
  }

  /// visit(side, share of its light that the receiver takes from there).
  template <typename Visit>
  void forEachSide(const Visit& visit) const {
    visit(1.0f, 1.0f - receiver_.transmission);
    if (receiver_.transmission > 0.0f) visit(-1.0f, receiver_.transmission);
  }

  void add(Asked asked) {
    asked.size = LinearRgb(asked.light).luminance();
    if (asked.size > 0.0f) asked_.push_back(asked);
  }

  void aim(const Asked& asked, float least, std::size_t rays) {
    Eigen::Array3f light = asked.light;
    if (asked.size < least) {  // one of several stands for all of them, so that their sum is kept
      passed_over_ += asked.size;
      if (passed_over_ < least) return;
      passed_over_ -= least;
      light *= least / asked.size;
    }
    for (std::size_t k = 0; k < rays; ++k) {
      Eigen::Vector3f at;
      if (!pointBefore(asked, &at)) continue;
      const Eigen::Vector3f origin = receiver_.start(sights_.size(), at - middle_);
      const Eigen::Vector3f way = at - origin;
      const float clear = 2.0f * rayClearance_m(origin, 0.0f) / std::max(way.norm(), 1e-6f);
      sights_.push_back({origin, way, 1.0f - clear});
      lights_.push_back(light / static_cast<float>(rays));
    }
  }

  /// A point of it at random, before the receiver's plane: what is not was cut off from the sum.
  bool pointBefore(const Asked& asked, Eigen::Vector3f* at) {
    constexpr int kTries = 16;
    for (int i = 0; i < kTries; ++i) {
      const Piece* piece = asked.cluster != nullptr ? &sources_.pick(*asked.cluster, chance()) : nullptr;
      if (piece != nullptr && !isSeen(*piece)) continue;
      float u = chance(), v = chance();
      if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
      const auto& [a, b, c] = piece != nullptr ? piece->corner : *asked.corner;
      *at = a + u * (b - a) + v * (c - a);
      const Eigen::Vector3f towards = *at - middle_;
      if (asked.side * receiver_.normal.dot(towards) > 0.0f && receiver_.weight(towards) > 0.0f) return true;
    }
    return false;
  }

  void cast() {
    std::vector<std::uint8_t> hidden;
    sources_.rays_.hide(sights_, &hidden);
    for (std::size_t i = 0; i < sights_.size(); ++i)
      if (!hidden[i]) (sights_[i].way.z() > 0.0f ? light_.above : light_.below) += lights_[i];
  }

  const ShiningSurfaces& sources_;
  const Receiver& receiver_;
  const std::uint64_t key_;
  std::uint64_t drawn_ = 0;  ///< random numbers
  Eigen::Vector3f middle_ = Eigen::Vector3f::Zero();
  std::vector<Asked> asked_;
  std::vector<BakeSight> sights_;
  std::vector<Eigen::Array3f> lights_;  ///< of each sight if nothing hides it, lx
  float passed_over_ = 0.0f;            ///< lx
  Light light_;
};

ShiningSurfaces::Light ShiningSurfaces::at(const Receiver& receiver, std::uint64_t key) const {
  return any() ? Look(*this, receiver, key).all() : Light();
}

}  // namespace sunlit::light
