/// Light of surfaces that are bright beside all others, sampled by what they give rather than met by chance:
/// a panel of a hand's width lights a hall.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "light/bake/samples/bake_rays.h"
#include "light/bake/samples/probe.h"

namespace sunlit::light {

class AreaLights {
 public:
  /// Part of a triangle that shines evenly.
  struct Piece {
    std::array<Eigen::Vector3f, 3> corner;
    Eigen::Vector3f normal;    ///< unit, to the front
    Eigen::Array3f luminance;  ///< cd/m²
    bool both;                 ///< sides shine
    float lamp_m = 0.0f;       ///< how far off the lamp is that it shines by; 0: it shines by itself
    float looked = 1.0f;       ///< share of its light that is looked for
    std::uint32_t triangle = 0;
    std::uint32_t side = 0;                            ///< of the triangle, 0 front, 1 back
    Eigen::Vector3f within = Eigen::Vector3f::Zero();  ///< barycentric coordinates of its middle

    Eigen::Vector3f middle() const { return (corner[0] + corner[1] + corner[2]) / 3.0f; }
    Eigen::AlignedBox3f box() const {
      return Eigen::AlignedBox3f(corner[0]).extend(corner[1]).extend(corner[2]);
    }
    float area_m2() const { return 0.5f * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm(); }
    /// cd, straight before it
    float power() const;
  };

  /// Keeps a reference to `rays`.
  AreaLights(const BakeRays& rays, std::vector<Piece> pieces);

  /// Whether there are any.
  bool any() const { return !pieces_.empty(); }

  /// Illuminance by them straight, of what shines by a lamp the share that lookedForFrom() tells, lx: from
  /// above the horizon, from below it; and how far off they are that would give it if nothing hid them, m
  /// (harmonic mean).
  struct Light {
    Eigen::Array3f above = Eigen::Array3f::Zero(), below = Eigen::Array3f::Zero();
    float distance_m = 1e9f;
  };
  /// Near ones are summed exactly but for what hides them, which rays to each part of them tell; far ones
  /// that face alike are taken together in clusters no wider than a quarter of their distance. The same for
  /// equal `key`, which chooses where rays go.
  Light at(const Receiver& receiver, std::uint64_t key) const;

  /// The same at less effort: as much on average over places, but less sure at each.
  Light about(const Receiver& receiver, std::uint64_t key) const;

  /// How far off the nearest of them is, m, about; `most_m` if that is farther.
  float distance_m(const Eigen::AlignedBox3f& box, float most_m) const;

 private:
  class Look;
  struct Effort;
  static const Effort kClosely, kAbout;
  /// Halves of halves of pieces that lie close together and face alike, or shine to both sides all of them.
  struct Cluster {
    Eigen::AlignedBox3f box;
    Eigen::Array3f intensity = Eigen::Array3f::Zero();  ///< cd, if all pieces faced the same place
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();   ///< mean, by power
    Eigen::Vector3f facing = Eigen::Vector3f::Zero();   ///< mean normal by power, shorter than 1
    float spread = 0.0f;                                ///< sine of the widest angle to it
    float radius_m = 0.0f;                              ///< half the diagonal of `box`
    bool both = false;                                  ///< sides shine
    float power = 0.0f;                                 ///< cd
    float lamp_m = 0.0f, least_lamp_m = 1e9f;           ///< Piece::lamp_m: mean by power, and the least
    std::uint32_t first = 0, end = 0;                   ///< pieces
    std::uint32_t second = 0;  ///< the second half; the first one follows its whole. 0: one piece alone
  };

  static int facing(const Piece& piece);
  static float formFactor(const Piece& piece, const Eigen::Vector3f& point, const Eigen::Vector3f& normal);
  void build();
  void build(std::uint32_t first, std::uint32_t end);
  void nearest(std::uint32_t number, const Eigen::AlignedBox3f& box, float* nearest_m) const;
  const Piece& pick(const Cluster& cluster, float chance) const;

  const BakeRays& rays_;
  std::vector<Piece> pieces_;
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> roots_;  ///< clusters that are no part of another one
  std::vector<double> powers_;        ///< of each piece and all before it
};

}  // namespace sunlit::light
