/// Light through even, level layers of cloud or fog droplets, scattered any number of times.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "sunlit/sky/fog.h"
#include "sunlit/sky/table_store.h"

namespace sunlit::sky {

/// What a thick cloud makes of the colour of a high sun's clear hour, which is 5,600 K here: D65, the CIE's
/// illuminant of overcast skies.
const Eigen::Array3f kOvercastBluing(0.902F, 1.019F, 1.098F);

/// Of layers of many optical depths, whose droplets take no light (but see DropletLayer::bluing()): adding
/// and doubling (van de Hulst 1963; de Haan, Bosma & Hovenier 1987) in 33 azimuthal modes and 32 directions
/// of Gauss up and down. What is scattered once is left out, since it has a closed form. Depths lie a factor
/// of √2 apart: at 2 the light about a low sun errs by 10 % between them.
class Droplets {
 public:
  static constexpr int kModes = 33;
  static constexpr int kNodes = 33;  ///< the zenith, then Gauss points towards the horizon
  static constexpr int kDepths = 32;
  static constexpr double kLeastDepth = 0x1p-7;

  /// A third of a second of processor time, unless they are among what is `kept`.
  explicit Droplets(const TableStore& kept = {});

  /// Angle of a node from the zenith, rad, rising from 0.
  const std::array<float, kNodes>& zenithAngles() const { return angles_; }

  /// A layer's answer to light from above, by node seen and node lit from, scattered at least twice: factors
  /// of π times the luminance over μ0 times the illuminance of a plane facing the light.
  const float* transmitted(int depth, int mode) const {
    return numbers_.data() + static_cast<std::size_t>((depth * kModes + mode) * kNodes * kNodes);
  }
  /// Luminance, by node, of the side that even light of luminance 1 falls on.
  const float* reflected(int depth) const {
    return numbers_.data() + static_cast<std::size_t>(kDepths * kModes * kNodes * kNodes + depth * kNodes);
  }

 private:
  void computeMode(int mode, const std::vector<double>& cosines, const std::vector<double>& weights);

  std::array<float, kNodes> angles_;
  std::vector<float> numbers_;
};

/// Share of light that goes straight through a layer at a cosine from the vertical of `mu` ≥ 0.
float passedStraight(float optical_depth, float mu);
/// What does not, to all digits also where that is next to nothing.
float stoppedOf(float optical_depth, float mu);

/// One of these layers, of any depth.
class DropletLayer {
 public:
  DropletLayer(const Droplets& droplets, double optical_depth);

  float opticalDepth() const { return depth_; }
  float passed(float mu) const { return passedStraight(depth_, mu); }

  /// Amplitudes of cos(m Δφ) of what is seen at an angle from the zenith of light from another, scattered at
  /// least twice: luminance for an illuminance of 1 of a plane facing the light.
  std::array<float, Droplets::kModes> modes(float seen_rad, float lit_rad) const;
  /// The first of these: of light from all round alike.
  float evenMode(float seen_rad, float lit_rad) const;
  /// The same of light scattered once, seen at one cosine from the vertical and lit at another.
  struct Once {
    float through, mu0;
    /// An angle between the two.
    float under(float cos_angle) const;
  };
  Once once(float mu, float mu0) const;
  /// Luminance seen at `angle_rad` from the vertical of the side that even light of luminance 1 falls on.
  float reflected(float angle_rad) const;
  /// What absorption in water makes of the colour of light that was scattered: bluer, the more the thicker
  /// (Lee & Hernández-Andrés 2005, Appl. Opt. 44, 5712). Of the same luminance.
  Eigen::Array3f bluing() const;
  /// Part of even light that is thrown back.
  float sphericalAlbedo() const { return spherical_albedo_; }

 private:
  struct Blend {
    std::size_t first;
    std::array<float, 4> weights;
  };
  Blend between(float angle_rad) const;
  float amplitude(std::size_t mode, const Blend& seen, const Blend& lit) const;

  float depth_;
  std::array<float, Droplets::kNodes> angles_;
  std::vector<float> transmitted_;  // by mode, seen and lit node
  std::array<float, Droplets::kNodes> reflected_;
  float spherical_albedo_;
};

}  // namespace sunlit::sky
