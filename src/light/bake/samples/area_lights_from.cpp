// What a place gets of lights that are areas.
#include <algorithm>
#include <cmath>
#include <optional>

#include "light/bake/samples/area_lights.h"
#include "light/bake/samples/looked_for.h"
#include "sunlit/quantity/photometry.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

/// Of the distance: as wide as clusters may be.
constexpr float kWidest = 0.25f;
/// Sine of angles between normals of a cluster and their mean that make no difference.
constexpr float kAlike = 0.15f;
/// lx: what is darker is not looked at, a hundredth of what a moonless sky gives.
constexpr float kDark_lx = 1e-5f;
/// lx: of what is fainter, a twentieth of moonlight, it is enough to know it about.
constexpr float kFaint_lx = 0.01f;
/// Rays that got through: the light of so many is known within a sixth.
constexpr std::size_t kEnough = 36;
/// Of the distance: as long as pieces may be before they are halved, and how often that is done at most.
constexpr float kLongest = 0.5f;
constexpr int kMostHalved = 20;
/// Rays of a place, as far as the most to each part allow.
struct RayCount {
  std::size_t all, most;
  std::size_t ofEach(std::size_t parts) const { return std::clamp<std::size_t>(all / parts, 1, most); }
};

}  // namespace

struct AreaLights::Effort {
  /// Of all that a place would get: clusters that may give no more are halved no further; nor is any, once so
  /// many are.
  float little;
  std::size_t most_halved;
  /// Of that: of parts that give less, some are asked for and count for more.
  float small;
  /// At first, and then where so few get through, though some do, as before a window that lets see a little
  /// of a lit room.
  std::array<RayCount, 3> rays;
};

namespace {

using Triangle = std::array<Eigen::Vector3f, 3>;

float longestEdge(const Triangle& corner) {
  return std::max(
      {(corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(), (corner[0] - corner[2]).norm()});
}

}  // namespace

/// Illuminance, lx per cd/m², of a plane at `point` with the unit normal `normal` by a triangle that shines
/// evenly and all of which is seen: the polygon formula of Lambert (1760), of the part before the plane.
float AreaLights::formFactor(const Piece& piece, const Eigen::Vector3f& point,
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
const AreaLights::Piece& AreaLights::pick(const Cluster& cluster, float chance) const {
  const double before = cluster.first > 0 ? powers_[cluster.first - 1] : 0.0;
  const double sought = before + static_cast<double>(chance) * (powers_[cluster.end - 1] - before);
  const auto found =
      std::upper_bound(powers_.begin() + cluster.first, powers_.begin() + cluster.end - 1, sought);
  return pieces_[static_cast<std::size_t>(found - powers_.begin())];
}

/// From one place.
class AreaLights::Look {
 public:
  Look(const AreaLights& sources, const Receiver& receiver, const Effort& effort, std::uint64_t key)
      : sources_(sources),
        receiver_(receiver),
        effort_(effort),
        key_(scrambled(key)),
        middle_(receiver.middle()) {
    gather();
    float over_distance = 0.0f;
    for (const Asked& asked : asked_) {
      unhidden_ += asked.size;
      over_distance += asked.size / std::max(asked.distance_m, 1e-3f);
    }
    if (unhidden_ > 0.0f) light_.distance_m = unhidden_ / over_distance;
  }

  /// What it gets if nothing hides any of them, lx.
  float unhidden() const { return unhidden_; }

  Light light() {
    if (!(unhidden_ > kDark_lx)) return light_;
    std::size_t cast_to_each = 0;
    for (const RayCount& count : effort_.rays) {
      const std::size_t each = count.ofEach(asked_.size());
      if (each == cast_to_each) break;
      cast_to_each = each;
      const std::size_t open = cast(each, effort_.small * unhidden_);
      if (open == 0 || open == sights_.size() || open > kEnough) break;
    }
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

  /// A cluster that is to be halved: it is wide, or faces the place in part.
  struct Coarse {
    float most;   ///< that it may give, lx
    float about;  ///< that it gives
    std::uint32_t number;
    bool operator<(const Coarse& other) const {
      return most != other.most ? most < other.most : number > other.number;
    }
  };

  /// Halves what may give most, until what is left matters little.
  void gather() {
    for (const std::uint32_t root : sources_.roots_) consider(root);
    for (std::size_t halved = 0; halved < effort_.most_halved && !coarse_.empty(); ++halved) {
      const Coarse largest = coarse_.front();
      if (largest.most <= effort_.little * about_) break;
      std::pop_heap(coarse_.begin(), coarse_.end());
      coarse_.pop_back();
      about_ -= largest.about;
      consider(largest.number + 1);
      consider(sources_.clusters_[largest.number].second);
    }
    for (const Coarse& left : coarse_) {
      const Cluster& cluster = sources_.clusters_[left.number];
      askFar(cluster);
    }
  }

  void consider(std::uint32_t number) {
    const Cluster& cluster = sources_.clusters_[number];
    const Eigen::Vector3f way = cluster.box.center() - middle_;
    if (isTooNear(cluster, way) || isBehind(cluster, way)) return;
    const std::size_t before = asked_.size();
    if (cluster.second == 0) {
      const Piece& piece = sources_.pieces_[cluster.first];
      if (isSeen(piece)) ask(piece, 0);
    } else if (isWide(cluster) || isSeenInPart(cluster)) {
      const float nearest_m2 = std::max(cluster.box.squaredExteriorDistance(middle_), 1e-6f);
      const float away_m2 = (cluster.middle - middle_).squaredNorm();
      const float most = cluster.power / nearest_m2,
                  about = cluster.power / (away_m2 + cluster.radius_m * cluster.radius_m);
      coarse_.push_back({most, about, number});
      std::push_heap(coarse_.begin(), coarse_.end());
      about_ += about;
    } else {
      askFar(cluster);
    }
    for (std::size_t i = before; i < asked_.size(); ++i) about_ += asked_[i].size;
  }

  /// Whether all of it shines by lamps that are no nearer to it than the place is; `way`: to its box's
  /// middle.
  static bool isTooNear(const Cluster& cluster, const Eigen::Vector3f& way) {
    if (!(cluster.least_lamp_m > 0.0f)) return false;
    return !(lookedForFrom(cluster.least_lamp_m, way.norm() + cluster.radius_m) > 0.0f);
  }

  /// Whether it lies below the place's plane, or the place behind those of all its pieces.
  bool isBehind(const Cluster& cluster, const Eigen::Vector3f& way) const {
    const Eigen::Vector3f half = 0.5f * cluster.box.diagonal();
    const auto reaches = [&](const Eigen::Vector3f& normal) {
      return normal.dot(way) + normal.cwiseAbs().dot(half);
    };
    if (!(receiver_.transmission > 0.0f) && reaches(receiver_.normal) <= 0.0f) return true;
    return !cluster.both && cluster.spread < kAlike && reaches(-cluster.facing) <= -kAlike * way.norm();
  }

  bool isWide(const Cluster& cluster) const {
    constexpr float kWidestRadius = 0.5f * kWidest;
    return cluster.radius_m * cluster.radius_m >
           kWidestRadius * kWidestRadius * cluster.box.squaredExteriorDistance(middle_);
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
  void askFar(const Cluster& cluster) {
    const Eigen::Vector3f way = cluster.middle - middle_;
    const float distance_m = way.norm(), before = -cluster.facing.dot(way) / distance_m;
    const float seen = cluster.both ? std::abs(before) : std::max(before, 0.0f);
    const float looked = lookedForFrom(cluster.lamp_m, distance_m);
    forEachSide([&](float side, float share) {
      const float cosine = std::max(side * receiver_.normal.dot(way) / distance_m, 0.0f);
      const Eigen::Array3f light =
          cluster.intensity * (looked * share * seen * cosine / (distance_m * distance_m));
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
    const float looked = lookedForFrom(piece.lamp_m, distance_m);
    forEachSide([&](float side, float share) {
      const float factor = looked * share * formFactor(piece, middle_, side * receiver_.normal);
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

  /// By `rays` to each part, or its share of those for parts that give less than `least`: sets the light, and
  /// returns how many got through.
  std::size_t cast(std::size_t rays, float least) {
    sights_.clear();
    lights_.clear();
    passed_over_ = chance() * least;
    for (const Asked& asked : asked_) aim(asked, least, rays);
    std::vector<std::uint8_t> hidden;
    sources_.rays_.hide(sights_, &hidden);
    light_.above.setZero();
    light_.below.setZero();
    std::size_t open = 0;
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      if (hidden[i]) continue;
      (sights_[i].way.z() > 0.0f ? light_.above : light_.below) += lights_[i];
      ++open;
    }
    return open;
  }

  const AreaLights& sources_;
  const Receiver& receiver_;
  const Effort& effort_;
  const std::uint64_t key_;
  const Eigen::Vector3f middle_;
  std::uint64_t drawn_ = 0;     ///< random numbers
  std::vector<Coarse> coarse_;  ///< a heap
  float about_ = 0.0f;          ///< lx, of all in it and in
  std::vector<Asked> asked_;
  std::vector<BakeSight> sights_;
  std::vector<Eigen::Array3f> lights_;          ///< of each sight if nothing hides it, lx
  float unhidden_ = 0.0f, passed_over_ = 0.0f;  ///< lx
  Light light_;
};

const AreaLights::Effort AreaLights::kClosely{0.005f, 300, 0.002f, {{{32, 8}, {128, 16}, {512, 64}}}},
    AreaLights::kAbout{0.03f, 32, 0.05f, {{{8, 4}, {8, 4}, {8, 4}}}};

AreaLights::Light AreaLights::at(const Receiver& receiver, std::uint64_t key) const {
  if (!any()) return {};
  Look about(*this, receiver, kAbout, key);
  return about.unhidden() < kFaint_lx ? about.light() : Look(*this, receiver, kClosely, key).light();
}

AreaLights::Light AreaLights::about(const Receiver& receiver, std::uint64_t key) const {
  return any() ? Look(*this, receiver, kAbout, key).light() : Light();
}

}  // namespace sunlit::light
