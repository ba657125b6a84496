#include "scene/noise.h"

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::scene {
namespace {

// Faster than std::floor where the instruction set has no rounding.
int floorToInt(float x) {
  const int i = static_cast<int>(x);
  return i - (x < static_cast<float>(i) ? 1 : 0);
}

// The final mixing of a hash, as a number in −1 … 1.
float spread(std::uint32_t h) {
  h ^= h >> 16;
  h *= 0x7FEB352Du;
  h ^= h >> 15;
  h *= 0x846CA68Bu;
  h ^= h >> 16;
  return static_cast<float>(h >> 8) * (2.0f / 16777216.0f) - 1.0f;
}

/// Looked up together.
constexpr int kLanes = 4;
struct Octaves {
  float x[kLanes], y[kLanes];
  std::uint32_t seed[kLanes];
};

SUNLIT_VECTOR_CLONES
void noises(const Octaves& at, float* __restrict values) {
  constexpr std::uint32_t kX = 0x9E3779B1u;
  constexpr std::uint32_t kY = 0x85EBCA77u;
  for (int i = 0; i < kLanes; ++i) {
    const int ix = floorToInt(at.x[i]);
    const int iy = floorToInt(at.y[i]);
    const float u = at.x[i] - static_cast<float>(ix);
    const float v = at.y[i] - static_cast<float>(iy);
    const float su = u * u * u * (u * (u * 6.0f - 15.0f) + 10.0f);
    const float sv = v * v * v * (v * (v * 6.0f - 15.0f) + 10.0f);
    const std::uint32_t left = static_cast<std::uint32_t>(ix) * kX;
    const std::uint32_t low = static_cast<std::uint32_t>(iy) * kY + at.seed[i] * 0xC2B2AE3Du;
    const float below = spread(left ^ low) * (1.0f - su) + spread((left + kX) ^ low) * su;
    const float above = spread(left ^ (low + kY)) * (1.0f - su) + spread((left + kX) ^ (low + kY)) * su;
    values[i] = below * (1.0f - sv) + above * sv;
  }
}

}  // namespace

std::uint32_t mix(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t h = a * 0x9E3779B1u ^ (b * 0x85EBCA77u + 0x165667B1u) ^ (c * 0xC2B2AE3Du + 0x27D4EB2Fu);
  h ^= h >> 16;
  h *= 0x7FEB352Du;
  h ^= h >> 15;
  h *= 0x846CA68Bu;
  h ^= h >> 16;
  return h;
}

std::uint32_t squareHash(float x, float y, std::uint32_t seed) {
  return mix(static_cast<std::uint32_t>(floorToInt(x)), static_cast<std::uint32_t>(floorToInt(y)), seed);
}

float noise(float x, float y, std::uint32_t seed) {
  Octaves at;
  std::fill_n(at.x, kLanes, x);
  std::fill_n(at.y, kLanes, y);
  std::fill_n(at.seed, kLanes, seed);
  float values[kLanes];
  noises(at, values);  // four cost as little as one
  return values[0];
}

float fractal(float x, float y, int octaves, std::uint32_t seed) {
  float sum = 0.0f;
  float strength = 0.6f;
  for (int first = 0; first < octaves; first += kLanes) {
    Octaves at;
    for (int i = 0; i < kLanes; ++i) {
      at.x[i] = x;
      at.y[i] = y;
      at.seed[i] = seed + 101u * static_cast<std::uint32_t>(first + i);
      // Turned between octaves, so that their lattices do not line up.
      const float turned = 1.6f * x - 1.2f * y + 17.3f;
      y = 1.2f * x + 1.6f * y - 5.1f;
      x = turned;
    }
    float values[kLanes];
    noises(at, values);
    for (int i = 0; i < std::min(kLanes, octaves - first); ++i) {
      sum += strength * values[i];
      strength *= 0.5f;
    }
  }
  return sum;
}

Cell cellular(float x, float y, std::uint32_t seed) {
  const int ix = floorToInt(x);
  const int iy = floorToInt(y);
  Cell cell{9.0f, 9.0f, 0u};
  for (int j = iy - 1; j <= iy + 1; ++j) {
    for (int i = ix - 1; i <= ix + 1; ++i) {
      const std::uint32_t h = mix(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), seed);
      const float dx = static_cast<float>(i) + static_cast<float>(h & 0xFFFFu) / 65536.0f - x;
      const float dy = static_cast<float>(j) + static_cast<float>(h >> 16) / 65536.0f - y;
      const float distance = std::sqrt(dx * dx + dy * dy);
      if (distance < cell.nearest) {
        cell = {distance, cell.nearest, h};
      } else {
        cell.second = std::min(cell.second, distance);
      }
    }
  }
  return cell;
}

float smoothStep(float low, float high, float value) {
  const float t = std::clamp((value - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace sunlit::scene
