/// The sky below an even layer of cloud or fog.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <functional>
#include <vector>

#include "droplets.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::sky {

/// What falls on a layer from above.
struct LightAbove {
  std::vector<DiscLight> discs;
  std::function<Eigen::Array3f(const Eigen::Vector3f& towards)>
      luminance;  ///< cd/m²; only asked above the horizon
};

/// Illuminance of level ground by it, lx.
Eigen::Array3f levelOf(const LightAbove& above);

/// Luminance of the light that a layer scatters down, of the discs and of the sky above it, and of the ground
/// below. Of the sky above, which the layer blurs, only the mean all round counts. Tabulated by elevation =
/// 90° · (row / (kRows − 1))² and azimuth.
class LayerSky {
 public:
  /// Over black ground.
  LayerSky(const DropletLayer& layer, const LightAbove& above);
  /// Over ground that throws back the part `albedo_below` of what falls on it, again and again.
  LayerSky(const DropletLayer& layer, const LightAbove& above, float albedo_below);
  /// Adds what the layer throws back of even light from below.
  void addFromBelow(const DropletLayer& layer, const Eigen::Array3f& luminance_below);

  /// Illuminance of level ground, lx, as it was over black ground.
  const Eigen::Array3f& level() const { return level_; }

  /// Where a direction lies in the table of every layer.
  struct Place {
    int row;           ///< its first node
    int column, next;  ///< around it
    float weights[4];  ///< of both, in this row and in that above
  };
  /// `towards` is a unit vector in `map`.
  static Place placeOf(const Eigen::Vector3f& towards);
  /// cd/m²; of the horizon below it.
  Eigen::Array3f scattered(const Eigen::Vector3f& towards) const { return scattered(placeOf(towards)); }
  Eigen::Array3f scattered(const Place& place) const;
  float depth() const { return depth_; }  ///< optical
  /// What of the light above goes straight through at an elevation of sine `z`.
  float passed(float z) const;
  /// What does not, to all digits also where that is next to nothing.
  float stopped(float z) const;

 private:
  static constexpr int kRows = 64;
  static constexpr int kColumns = 96;

  void addSky(const DropletLayer& layer, const LightAbove& above);
  void addDisc(const DropletLayer& layer, const DiscLight& disc);
  Eigen::Array3f levelBelow(const DropletLayer& layer, const LightAbove& above) const;

  float depth_;
  Eigen::Array3f level_ = Eigen::Array3f::Zero();
  std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>>
      nodes_;  // cd/m²; the fourth is padding
};

}  // namespace sunlit::sky
