/// Fractal detail of a material as a camera at one place sees it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "sunlit/scene/scene.h"

namespace sunlit::render {

/// Octaves of gradient noise on a simplex lattice, each turned by another rotation, so that no lattice shows.
/// Coordinates are counted from the camera, whose own place in each octave's lattice is kept as whole cells
/// and a fraction: the noise stands still in `map` to a fraction of a millimetre, however far from the
/// origin.
struct DetailOctaves {
  static constexpr int kMax = 16;  ///< coarsest_m / finest_m beyond 2^15 is cut off at the fine end

  DetailOctaves(const scene::Detail& detail, const Eigen::Vector3d& eye);

  int count = 0;
  std::array<Eigen::Matrix3f, kMax> lattice_from_map;             ///< turns, and divides by the wavelength
  std::array<Eigen::Vector3f, kMax> eye_fraction;                 ///< the camera within its cell
  std::array<Eigen::Matrix<std::uint32_t, 3, 1>, kMax> eye_cell;  ///< in the skewed lattice, modulo 2^32
  std::array<float, kMax> weight;  ///< standard deviation 1 of the noise becomes this
  std::array<float, kMax> wavelength_m;
};

/// Places to evaluate at once. Neighbours should be alike in footprint.
struct DetailPoints {
  static constexpr int kCount = 16;
  std::array<float, kCount> x, y, z;    ///< middle, from the camera, along the axes of `map`, m
  std::array<float, kCount> footprint;  ///< what one sample covers there, along its longer side, m
  std::array<float, kCount> spread;     ///< of the place's samples, see detailSpread_m()
};

/// How far the samples of a place lie from their middle, m, as the mean over them weighs waves:
/// `samples` in a square, of which each is `longer_m` by `shorter_m`.
float detailSpread_m(std::uint32_t samples, float longer_m, float shorter_m);

/// The noise, in the mean over each place's samples, of those octaves that a sample can show: factor 1 + tint
/// · sum goes to the albedo.
void sumOctaves(const DetailOctaves& octaves, const DetailPoints& points,
                std::array<float, DetailPoints::kCount>* sums);

}  // namespace sunlit::render
