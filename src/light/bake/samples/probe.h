/// Rays of one fixed pattern around points of the scene, many points at a time.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "light/bake/samples/bake_rays.h"
#include "light/patches/sky_patches.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// Normals at least so near to one another, by their cosine, may share what is gathered: within 23°, where
/// light from all around differs by less than 4 %.
constexpr float kSharedCosine = 0.92f;

/// Receiver::face of a surface with normal `face` that is shaded by `normal`, both unit.
inline Eigen::Vector3f boundingFace(const Eigen::Vector3f& normal, const Eigen::Vector3f& face) {
  return normal.dot(face) < kSharedCosine ? face : Eigen::Vector3f(Eigen::Vector3f::Zero());
}

/// Whether two values of Receiver::face are about the same.
inline bool sameFace(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  constexpr float kFar = 2.0f - 2.0f * kSharedCosine;  // squared distance of unit vectors
  return (a - b).squaredNorm() < kFar;
}

/// What light counts that meets a surface by this cosine to its normal, if it takes `transmission` of its
/// light from behind.
inline float countedCosine(float cosine, float transmission) {
  return cosine > 0.0f ? (1.0f - transmission) * cosine : -transmission * cosine;
}

/// A point that gathers light, or some that do it together.
struct Receiver {
  static constexpr int kOrigins = 4;
  /// How far above its surface, there, rays start.
  static float clearance_m(const Eigen::Vector3f& origin) {
    return std::max(5e-3f, rayClearance_m(origin, 0.0f));
  }
  std::array<Eigen::Vector3f, kOrigins> origins;  ///< on the surface; rays take them in turn
  std::array<Eigen::Vector3f, kOrigins> lifts;    ///< from there to where rays of the lit side start
  Eigen::Vector3f normal;                         ///< unit, that the light is shaded by
  /// Unit normal of the surface itself where `normal` leans far from it (see boundingFace()), else zero: what
  /// lies below the surface gives no light, though it lies before `normal`.
  Eigen::Vector3f face = Eigen::Vector3f::Zero();
  float transmission = 0.0f;  ///< share of its light that it takes from behind
  bool thin = false;          ///< of a sheet: rays leave from either side of it
  bool coarse = false;        ///< the coarse rays are enough: there are many like it

  /// What light from a direction counts, for a unit of solid angle; over the sphere it adds up to π times
  /// open().
  float weight(const Eigen::Vector3f& towards) const {
    if (face.dot(towards) < 0.0f) return 0.0f;
    return countedCosine(normal.dot(towards), transmission);
  }
  /// Share of what lies before `normal`, by cosine, that lies before `face` too.
  float open() const { return face.isZero() ? 1.0f : 0.5f * (1.0f + normal.dot(face)); }
  /// Of its origins, clear of the surface, lest one that shines lights itself.
  Eigen::Vector3f middle() const {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t k = 0; k < kOrigins; ++k) sum += origins[k] + lifts[k];
    return sum / static_cast<float>(kOrigins);
  }
  Eigen::Vector3f start(std::size_t turn, const Eigen::Vector3f& towards) const {
    const Eigen::Vector3f& origin = origins[turn % kOrigins];
    const Eigen::Vector3f& lift = lifts[turn % kOrigins];
    return lift.dot(towards) > 0.0f || !thin ? Eigen::Vector3f(origin + lift)
                                             : Eigen::Vector3f(origin - lift);
  }
};

/// Up to a packet of receivers whose rays of one direction travel together: they should be neighbours.
class ReceiverGroup {
 public:
  /// One bit for each receiver.
  using Lanes = std::uint32_t;
  static bool has(Lanes lanes, int receiver) { return (lanes >> receiver & 1u) != 0; }

  /// Keeps `receivers`, of which there are 1 … RayPacket::kSize.
  ReceiverGroup(const Receiver* receivers, int count);
  int count() const { return count_; }
  /// Those whose coarse rays are enough.
  Lanes coarse() const {
    Lanes lanes = 0;
    for (int i = 0; i < count_; ++i) lanes |= Lanes{receivers_[i].coarse} << i;
    return lanes;
  }

  /// Sets Receiver::weight() of each receiver; zero beyond them. Returns those that it is not zero for.
  Lanes weigh(const Eigen::Vector3f& towards, float* weights) const {
    weigh(facings_, towards, weights);
    Lanes lanes = 0;
    for (int i = 0; i < RayPacket::kSize; ++i) lanes |= Lanes{weights[i] > 0.0f} << i;
    return lanes;
  }
  /// Rays of one direction.
  struct Shot {
    std::size_t turn;  ///< whose it is among the origins of each receiver
    const Eigen::Vector3f& towards;
    Lanes lanes;  ///< receivers that cast one
  };
  void cast(const BakeRays& scene, const Shot& shot, HitLayers* hits) const {
    const Eigen::Vector3f& towards = shot.towards;
    RayPacket packet;
    for (int i = 0; i < RayPacket::kSize; ++i) {
      packet.set(static_cast<std::size_t>(i), receivers_[std::min(i, count_ - 1)].start(shot.turn, towards),
                 towards, has(shot.lanes, i));
    }
    scene.cast(packet, hits);
  }

 private:
  /// What Receiver::weight() asks for, value by value.
  struct Facings {
    alignas(64) float normal_x[RayPacket::kSize], normal_y[RayPacket::kSize], normal_z[RayPacket::kSize];
    alignas(64) float face_x[RayPacket::kSize], face_y[RayPacket::kSize], face_z[RayPacket::kSize];
    alignas(64) float transmission[RayPacket::kSize];
  };
  static void weigh(const Facings& facings, const Eigen::Vector3f& towards, float* weights);

  const Receiver* receivers_;
  int count_;
  Facings facings_;
};

/// Casts each of `rays` that counts for a receiver, and calls visit(i, ray, weight, hits): the index of the
/// receiver
/// (< 16), that of the ray, Receiver::weight() times the ray's solid angle, and the hits, of which lane i is
/// the receiver's.
template <typename Visit>
void probe(const BakeRays& scene, const std::vector<SkyPatches::Ray>& rays, const ReceiverGroup& receivers,
           const Visit& visit) {
  HitLayers hits;
  float weights[RayPacket::kSize];
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const ReceiverGroup::Lanes lanes = receivers.weigh(rays[r].towards, weights);
    if (lanes == 0) continue;
    receivers.cast(scene, {r, rays[r].towards, lanes}, &hits);
    for (int i = 0; i < receivers.count(); ++i) {
      if (ReceiverGroup::has(lanes, i)) visit(i, r, weights[i] * rays[r].solid_angle, hits);
    }
  }
}

}  // namespace sunlit::light
