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

/// Points to evaluate at once. Neighbours should be alike in footprint.
struct DetailPoints {
  static constexpr int kCount = 16;
  std::array<float, kCount> x, y, z;    ///< from the camera, along the axes of `map`, m
  std::array<float, kCount> footprint;  ///< what one sample covers there, along its longer side, m
};

/// Wavelengths by the number of samples that they span.
enum class DetailBand {
  kCoarse,  ///< many: hardly vary within a pixel
  kFine,    ///< few: a pixel needs all its samples, to average what it cannot show
};

/// The noise of those octaves of `band` that a sample can show: factor 1 + tint · sum of both bands goes to
/// the albedo.
void sumOctaves(const DetailOctaves& octaves, DetailBand band, const DetailPoints& points,
                std::array<float, DetailPoints::kCount>* sums);

}  // namespace sunlit::render
