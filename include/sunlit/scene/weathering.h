/// What weather leaves on surfaces: water and snow.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "sunlit/quantity/field.h"
#include "sunlit/scene/scene.h"
#include "sunlit/scene/shape.h"

namespace sunlit::scene {

/// The default is dry.
struct SurfaceState {
  double wet = 0.0;
  double puddles = 0.0;
  double snow_m = 0.0;
  int seed = 0;
};

inline std::vector<Field> fieldsOf(SurfaceState& state) {
  return {
      {"wet",
       &state.wet,
       "",
       {0, 1},
       "surfaces under the open sky: 0 dry, 1 soaked and under a film of water"},
      {"puddles", &state.puddles, "", {0, 0.9}, "share of the level ground that stands under water"},
      {"snow",
       &state.snow_m,
       "m",
       {0, 0.5},
       "depth of fresh snow: 0.02 covers two thirds of the ground, 0.1 nearly all"},
      {"ground_seed", &state.seed, "", {0, 2147483647}, "another seed, other puddles and patches of snow"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const SurfaceState& state);
bool isDry(const SurfaceState& state);
/// Whether they make the same surfaces.
bool operator==(const SurfaceState& a, const SurfaceState& b);

class TopHeights;

/// Water and snow of one state on one scene. Rain and snow fall straight down, past what is cut out or
/// blends, onto all that stands under the open sky; what lies deeper than the topmost surface stays dry.
/// Immutable.
class Weathering {
 public:
  /// Takes tenths of a second, about one with puddles. The same bits for any number of threads.
  Weathering(const Shape& shape, const std::vector<Material>& materials, const SurfaceState& state);

  /// What is looked at.
  struct Place {
    Eigen::Vector3f position;  ///< m in `map`
    Eigen::Vector3f face;      ///< unit, of the triangle, on the side that is looked at
    float footprint_m;         ///< what is looked at as one is so wide
  };
  /// What shading knows of a surface.
  struct Look {
    Eigen::Array3f albedo;
    Eigen::Vector3f normal;
    float roughness, metalness;
    float film = 0.0f;  ///< share that mirrors as water does, 0 … 1: kFilmReflectance at normal incidence
  };
  /// Puddles stand on level ground, first where it lies below the land around it within 4 m, by the map of
  /// the topmost surfaces; what that does not know (unevenness of some millimetres) the
  /// seed does. Water: a soaked rough dielectric of albedo ρ has ρ (1 − p) / (1 − p ρ),
  /// p = 0.4749, under its film (Lekner & Dorf 1988, Applied Optics 27, 1278, eq. 10 with n = 4/3:
  /// kInnerReflectance). Film and gloss: see equations.md. Snow: kSnowAlbedo on the share tanh(depth / 0.025
  /// m) of what faces up (Yang et al. 1997, of 1 cm rough ground), on slopes up to 40°, less and less up to
  /// 60°.
  void apply(const Place& place, const Material& material, Look* look) const;

  const SurfaceState& state() const { return state_; }

  /// Of water of refractive index 4/3, at normal incidence: ((n − 1) / (n + 1))².
  static constexpr float kFilmReflectance = 1.0f / 49.0f;
  /// Of light from within, evenly spread, at its surface: 1 − (1 − 0.0664) / n², where 0.0664 is that of
  /// light from outside.
  static constexpr float kInnerReflectance = 0.47485f;
  /// In the visible, a little soiled: pure fresh snow has 0.96 to 0.99 (Warren & Wiscombe 1980).
  static constexpr float kSnowAlbedo = 0.9f;

 private:
  /// Noise of which a share is below a threshold.
  struct Patches {
    float wavelength_m = 1.0f;
    std::uint32_t seed = 0;
    float threshold = 0.0f;
    float share = 0.0f;

    Patches() = default;
    Patches(float wavelength_m, std::uint32_t seed, double share);
    float noise(float x, float y) const;
    /// What the share asked for of `values` lies below becomes the threshold.
    void divide(std::vector<float> values);
    /// Of a square so wide about (x, y), how much lies in a patch, where the noise is raised by `lift`.
    float cover(float x, float y, float width_m, float lift = 0.0f) const;
  };
  /// Puddles of the share asked for, first in the hollows of the land.
  void floodHollows();
  /// How far a place lies above the land around it, in parts of puddles_' noise.
  float lift(const Eigen::Vector2f& place) const;
  /// Share of the rain that gets there.
  float open(const Place& place) const;
  Eigen::Vector3f drifts(const Place& place) const;
  void wet(float film, float standing, const Material& material, Look* look) const;

  SurfaceState state_;
  std::shared_ptr<const TopHeights> tops_;
  std::vector<std::int8_t> relief_;  ///< TopHeights::relief(), where there are puddles
  Patches puddles_, snow_;
};

}  // namespace sunlit::scene
