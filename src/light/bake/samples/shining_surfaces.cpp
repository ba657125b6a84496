#include "light/bake/samples/shining_surfaces.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "light/geometry/cutout.h"
#include "light/shading/reflectances.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/quantity/photometry.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

/// Of the distance: as wide as clusters may be.
constexpr float kWidest = 0.25f;
/// Of all that a place would get: of what gives less, some are asked for and count for more.
constexpr float kSmall = 0.002f;
/// A triangle that shines unevenly is cut into the square of so many pieces, as long as all of them are not
/// more than that.
constexpr int kAcross = 8;
constexpr double kMostPieces = 1e6;
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

Eigen::AlignedBox3f boxOf(const Triangle& corner) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : corner) box.extend(point);
  return box;
}

/// The parts of a triangle, by (u, v) of their corners: across² of them.
std::vector<std::array<Eigen::Vector2f, 3>> partsOf(int across) {
  std::vector<std::array<Eigen::Vector2f, 3>> parts;
  const float step = 1.0f / static_cast<float>(across);
  const Eigen::Vector2f right(step, 0.0f), up(0.0f, step);
  for (int i = 0; i < across; ++i) {
    for (int j = 0; i + j < across; ++j) {
      const Eigen::Vector2f at = static_cast<float>(i) * right + static_cast<float>(j) * up;
      parts.push_back({at, at + right, at + up});
      if (i + j + 1 < across) parts.push_back({at + right, at + right + up, at + up});
    }
  }
  return parts;
}

bool shines(const scene::Material& material) {
  return material.emission.value.maxCoeff() > 0.0f && material.lamp_group.empty();
}

/// How much of a triangle is there, where it is cut out or blends.
class Solidity {
 public:
  explicit Solidity(const Geometry& geometry) : cutouts_(geometry) {
    const std::vector<std::uint32_t>& masked = cutouts_.maskedTriangles();
    for (std::uint32_t i = 0; i < masked.size(); ++i) number_.emplace(masked[i], i);
  }

  /// 0 … 1, of a part by (u, v) of its corners: by sixteen points of it.
  float share(std::uint32_t triangle, const std::array<Eigen::Vector2f, 3>& part) const {
    const auto found = number_.find(triangle);
    if (found == number_.end()) return 1.0f;
    constexpr int kSteps = 4;
    int solid = 0;
    for (const auto& [a, b, c] : partsOf(kSteps)) {
      const Eigen::Vector2f middle = (a + b + c) / 3.0f;
      const Eigen::Vector2f at =
          part[0] + middle.x() * (part[1] - part[0]) + middle.y() * (part[2] - part[0]);
      solid += cutouts_.solid(found->second, at.x(), at.y()) ? 1 : 0;
    }
    return static_cast<float>(solid) / static_cast<float>(kSteps * kSteps);
  }

 private:
  Cutouts cutouts_;
  std::unordered_map<std::uint32_t, std::uint32_t> number_;  ///< among the masked ones
};

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

ShiningSurfaces::ShiningSurfaces(const Geometry& geometry, const BakeRays& rays,
                                 const std::vector<TriangleTraits>& traits)
    : rays_(rays) {
  const std::vector<scene::Material>& materials = geometry.scene->materials;
  if (std::none_of(materials.begin(), materials.end(), shines)) return;
  add(geometry, traits);
  if (any()) build(0, static_cast<std::uint32_t>(pieces_.size()));
}

void ShiningSurfaces::add(const Geometry& geometry, const std::vector<TriangleTraits>& traits) {
  const Reflectances reflectances(geometry);
  const Solidity solidity(geometry);
  std::vector<std::uint32_t> shining;
  std::size_t uneven = 0;
  const auto materialOf = [&](std::uint32_t t) -> const scene::Material& {
    return geometry.scene->materials[static_cast<std::size_t>(geometry.materials[t])];
  };
  const auto isUneven = [&](std::uint32_t t) {
    return materialOf(t).emission_map.given() || materialOf(t).alpha_mode != scene::AlphaMode::kOpaque;
  };
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    if (!shines(materialOf(t))) continue;
    shining.push_back(t);
    uneven += isUneven(t) ? 1 : 0;
  }
  const double each = std::sqrt(kMostPieces / static_cast<double>(std::max<std::size_t>(uneven, 1)));
  const int most_across = std::clamp(static_cast<int>(each), 1, kAcross);
  for (const std::uint32_t t : shining) {
    const scene::Material& material = materialOf(t);
    const auto& corners = geometry.triangles[t];
    const Eigen::Vector3f& a = geometry.positions[corners[0]];
    const Eigen::Vector3f ab = geometry.positions[corners[1]] - a, ac = geometry.positions[corners[2]] - a;
    const int across = isUneven(t) ? most_across : 1;
    for (const auto& part : partsOf(across)) {
      Piece piece;
      Reflectances::Part corners_of_part;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const Eigen::Vector2f& at = part[static_cast<std::size_t>(k)];
        piece.corner[static_cast<std::size_t>(k)] = a + at.x() * ab + at.y() * ac;
        corners_of_part.col(k) << 1.0f - at.sum(), at.x(), at.y();
      }
      piece.normal = geometry.planes[t].normal;
      piece.luminance = solidity.share(t, part) * reflectances.emission(t, corners_of_part);
      piece.both = material.double_sided && !traits[t].sealed[1];
      const float area = 0.5f * ab.cross(ac).norm() / static_cast<float>(across * across);
      piece.power = LinearRgb(piece.luminance).luminance() * area * (piece.both ? 2.0f : 1.0f);
      if (piece.power > 0.0f) pieces_.push_back(piece);
    }
  }
}

void ShiningSurfaces::build(std::uint32_t first, std::uint32_t end) {
  const std::size_t own = clusters_.size();
  Cluster cluster;
  cluster.first = first;
  cluster.end = end;
  Eigen::AlignedBox3f middles;
  for (std::uint32_t i = first; i < end; ++i) {
    cluster.box.extend(boxOf(pieces_[i].corner));
    middles.extend(pieces_[i].middle());
    cluster.power += pieces_[i].power;
  }
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
    gather(0);
    float sum = 0.0f, over_distance = 0.0f;
    for (const Asked& asked : asked_) {
      sum += asked.size;
      over_distance += asked.size / std::max((asked.corner[0] - middle_).norm(), 1e-3f);
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
    Triangle corner;
    Eigen::Array3f light;  ///< lx
    float size;            ///< luminance of it
    float side;            ///< of the receiver, 1 or −1: before or behind its normal
  };
  float chance() { return uniform(key_, drawn_++); }

  void gather(std::uint32_t number) {
    const Cluster& cluster = sources_.clusters_[number];
    const float wide = cluster.box.diagonal().norm();
    if (cluster.second != 0 && wide > kWidest * cluster.box.exteriorDistance(middle_)) {
      gather(number + 1);
      gather(cluster.second);
      return;
    }
    const Piece& piece = sources_.pick(cluster, cluster.second != 0 ? chance() : 0.0f);
    if (!piece.both && piece.normal.dot(middle_ - piece.corner[0]) <= 0.0f) return;
    ask(piece, cluster.power / piece.power, 0);
  }

  /// Asks for a piece that stands for `times` as much, or for its halves.
  void ask(const Piece& piece, float times, int halved) {
    if (longestEdge(piece.corner) > kLongest * boxOf(piece.corner).exteriorDistance(middle_) &&
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
        ask(half, times, halved + 1);
      }
      return;
    }
    askFrom(1.0f, (1.0f - receiver_.transmission) * times, piece);
    if (receiver_.transmission > 0.0f) askFrom(-1.0f, receiver_.transmission * times, piece);
  }

  /// From one side of the receiver.
  void askFrom(float side, float times, const Piece& piece) {
    const float factor = formFactor(piece, middle_, side * receiver_.normal);
    if (!(factor > 0.0f)) return;
    const Eigen::Array3f light = piece.luminance * (factor * times);
    asked_.push_back({piece.corner, light, LinearRgb(light).luminance(), side});
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

  /// A point of a triangle at random, before the receiver's plane: what is not was cut off from the sum.
  bool pointBefore(const Asked& asked, Eigen::Vector3f* at) {
    constexpr int kTries = 16;
    for (int i = 0; i < kTries; ++i) {
      float u = chance(), v = chance();
      if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
      const auto& [a, b, c] = asked.corner;
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
