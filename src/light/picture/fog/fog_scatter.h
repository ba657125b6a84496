/// What fog scatters of one lamp's light on a line of sight.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "light/lamps/lamp_beam.h"
#include "sunlit/sky/fog.h"

namespace sunlit::light {

/// Distances from the eye, or from where its way enters the fog, between which light is summed up: from 0 to
/// where hardly anything more comes through, longer the farther away.
class FogSlices {
 public:
  static constexpr std::size_t kCount = 32;

  explicit FogSlices(const sky::Fog& fog);
  float end(std::size_t i) const { return ends_[i]; }  ///< i ≤ kCount; end(0) is 0
  float last() const { return ends_.back(); }
  /// Of the slice that `distance_m` lies in, from its number: 3.5 is the middle of number 3. Below 0 it is 0.
  float place(float distance_m) const;

 private:
  std::array<float, kCount + 1> ends_;
};

/// Luminance of the fog on a line of sight, cd/m².
struct GlowProfile {
  std::array<Eigen::Array3f, FogSlices::kCount + 1> before;  ///< each end of the slices
  std::array<Eigen::Array3f, FogSlices::kCount> last;        ///< each slice's, where one looks no farther
};
/// Share of a lamp that is not hidden from the fog, by slice.
using OpenSlices = std::array<float, FogSlices::kCount>;
/// The same where one looks farther, and where a slice is the last.
struct LampOpen {
  OpenSlices passed, last;
};

/// Single scattering, with less extinction than there is, since light that droplets hardly turn is not lost
/// to the glow: k times that, on the way from the lamp as on that to the eye, k = 1 / (1 + a / 5°), at least
/// kLeastExtinction = 1 − g², a being the angle between the line of sight and the lamp. A fit of our
/// own to a Monte Carlo of all orders of scattering: within a sixth of it from 1 to 15° about a lamp in 0.4
/// optical depths, two fifths in 1.2; 15 % for headlights beside the eye at a visibility of 150 m, a quarter
/// at 50 m. Farther about a lamp in thick fog it is too dark, where there is little light.
class FogScatter {
 public:
  static constexpr auto kAsymmetry = static_cast<float>(sky::kDropletAsymmetry);
  static constexpr float kLeastExtinction = 1.0f - kAsymmetry * kAsymmetry;

  FogScatter(const LampBeam& beam, const sky::Fog& fog, const Eigen::Vector3f& eye);

  /// Adds the lamp's light on the way `towards`, a unit vector.
  void addAlong(const Eigen::Vector3f& towards, const FogSlices& slices, const LampOpen& open,
                GlowProfile* profile) const;
  /// Where the light of a part of such a way comes from, in `map`: the middle of the angles at which the lamp
  /// sees it, between two distances from where fog begins. `towards` meets fog.
  Eigen::Vector3f middle(const Eigen::Vector3f& towards, float from_m, float to_m) const;
  const LampBeam& beam() const { return beam_; }

 private:
  /// A line of sight from where fog begins, seen from the lamp.
  struct Line;

  const LampBeam& beam_;
  sky::Fog fog_;
  Eigen::Vector3f eye_;
};

}  // namespace sunlit::light
