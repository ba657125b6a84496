#include "scene/race_track/noise.h"

#include <algorithm>
#include <cmath>

namespace sunlit::scene::race_track {
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
  const int ix = floorToInt(x);
  const int iy = floorToInt(y);
  const float u = x - static_cast<float>(ix);
  const float v = y - static_cast<float>(iy);
  const float su = u * u * u * (u * (u * 6.0f - 15.0f) + 10.0f);
  const float sv = v * v * v * (v * (v * 6.0f - 15.0f) + 10.0f);
  constexpr std::uint32_t kX = 0x9E3779B1u;
  constexpr std::uint32_t kY = 0x85EBCA77u;
  const std::uint32_t left = static_cast<std::uint32_t>(ix) * kX;
  const std::uint32_t low = static_cast<std::uint32_t>(iy) * kY + seed * 0xC2B2AE3Du;
  const float below = spread(left ^ low) * (1.0f - su) + spread((left + kX) ^ low) * su;
  const float above = spread(left ^ (low + kY)) * (1.0f - su) + spread((left + kX) ^ (low + kY)) * su;
  return below * (1.0f - sv) + above * sv;
}

float fractal(float x, float y, int octaves, std::uint32_t seed) {
  float sum = 0.0f;
  float strength = 0.6f;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * noise(x, y, seed + 101u * static_cast<std::uint32_t>(i));
    // Turned between octaves, so that their lattices do not line up.
    const float turned = 1.6f * x - 1.2f * y + 17.3f;
    y = 1.2f * x + 1.6f * y - 5.1f;
    x = turned;
    strength *= 0.5f;
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

}  // namespace sunlit::scene::race_track
