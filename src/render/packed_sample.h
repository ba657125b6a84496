/// One sample of the geometry buffer as it comes from GL.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

namespace sunlit::render {

struct PackedSample {
  std::uint32_t albedo;      ///< 10 bit each of r, g, b (lowest bits first), square root of the linear value
  std::uint32_t normal;      ///< shading normal, octahedral, two signed 16-bit numbers; kNoNormal
  std::uint32_t triangle;    ///< index into light::Geometry::triangles plus 1; 0 for sky
  std::uint32_t depth_bits;  ///< float, m along the optical axis

  static constexpr std::uint32_t kNoNormal = 0x80008000u;

  bool sky() const { return triangle == 0; }

  float depth() const {
    float value;
    std::memcpy(&value, &depth_bits, sizeof(value));
    return value;
  }

  Eigen::Array3f linearAlbedo() const {
    const Eigen::Array3f root(static_cast<float>(albedo & 1023u), static_cast<float>((albedo >> 10) & 1023u),
                              static_cast<float>((albedo >> 20) & 1023u));
    return (root * (1.0f / 1023.0f)).square();
  }

  /// Not normalised; empty where the file gave none.
  std::optional<Eigen::Vector3f> shadingNormal() const {
    if (normal == kNoNormal) return std::nullopt;
    const float x = static_cast<float>(static_cast<std::int16_t>(normal & 0xffffu)) / 32767.0f;
    const float y = static_cast<float>(static_cast<std::int16_t>(normal >> 16)) / 32767.0f;
    const float z = 1.0f - std::abs(x) - std::abs(y);
    if (z >= 0.0f) return Eigen::Vector3f(x, y, z);
    return Eigen::Vector3f((1.0f - std::abs(y)) * (x >= 0.0f ? 1.0f : -1.0f),
                           (1.0f - std::abs(x)) * (y >= 0.0f ? 1.0f : -1.0f), z);
  }
};
static_assert(sizeof(PackedSample) == 16, "read back from GL as RGBA32UI");

}  // namespace sunlit::render
