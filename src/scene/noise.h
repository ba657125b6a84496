/// Pseudo-random numbers and noise from integer hashes: the same bits on every platform, unlike the
/// distributions of the standard library.
#pragma once

#include <cstdint>

namespace sunlit::scene {

/// A well-mixed 32-bit hash of up to three integers.
std::uint32_t mix(std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0);

/// A stream of pseudo-random numbers; equal seeds give equal streams. The order of draws is part of the
/// picture, so there is at most one draw where the language leaves the order of evaluation open (arguments,
/// operands).
class Random {
 public:
  explicit Random(std::uint32_t seed) : seed_(seed) {}
  Random(std::uint32_t seed, std::uint32_t which) : seed_(mix(seed, which, 77u)) {}

  std::uint32_t bits() { return mix(seed_, ++count_); }
  /// Uniform in [0, 1).
  float unit() { return static_cast<float>(bits() >> 8) * (1.0f / 16777216.0f); }
  /// Uniform in [low, high).
  float range(float low, float high) { return low + (high - low) * unit(); }
  /// Uniform in 0 … count − 1; count > 0.
  int below(int count) { return static_cast<int>(bits() % static_cast<std::uint32_t>(count)); }
  bool chance(float probability) { return unit() < probability; }
  /// Bell-shaped, mean 0, standard deviation 1, within ±3.5 (sum of four uniforms).
  float bell() {
    float sum = unit();
    for (int i = 0; i < 3; ++i) sum += unit();
    return (sum - 2.0f) * 1.7320508f;
  }

 private:
  std::uint32_t seed_;
  std::uint32_t count_ = 0;
};

/// The hash of the square of the given grid that (x, y) lies in.
std::uint32_t squareHash(float x, float y, std::uint32_t seed);

/// Smooth noise of wavelength 1 in −1 … 1.
float noise(float x, float y, std::uint32_t seed);

/// Sum of `octaves` of noise, each of half the wavelength and half the strength of the one before; about
/// −1 … 1.
float fractal(float x, float y, int octaves, std::uint32_t seed);

/// Distances to the nearest and second-nearest of points scattered one a unit cell, and the hash of the
/// nearest.
struct Cell {
  float nearest;
  float second;
  std::uint32_t id;
};
Cell cellular(float x, float y, std::uint32_t seed);

/// 0 below `low`, 1 above `high`, smooth between.
float smoothStep(float low, float high, float value);

}  // namespace sunlit::scene
