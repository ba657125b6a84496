/// The light of all nodes of a bake, in half of the memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "sunlit/light/illumination.h"

namespace sunlit::light {

/// A number from 0 to 5·10⁸ in 16 bits: 10 of mantissa, 6 of exponent. Off by 2⁻¹¹ of it, 0.05 %, and 3·10⁻¹⁴
/// at most; zero stays zero.
class PackedLight {
 public:
  PackedLight() = default;
  explicit PackedLight(float value) {
    const float shifted = std::clamp(value, 0.0f, kMost) + kLeast;
    std::uint32_t bits = 0;
    std::memcpy(&bits, &shifted, sizeof(bits));
    code_ = static_cast<std::uint16_t>(((bits + kHalf) >> kDropped) - (kLeastBits >> kDropped));
  }
  float value() const { return valuesOf<1>(this)[0]; }
  /// Of so many, side by side.
  template <std::size_t N>
  static std::array<float, N> valuesOf(const PackedLight* packed) {
    std::array<std::uint32_t, N> bits;
    for (std::size_t i = 0; i < N; ++i)
      bits[i] = (static_cast<std::uint32_t>(packed[i].code_) << kDropped) + kLeastBits;
    std::array<float, N> values;
    std::memcpy(values.data(), bits.data(), sizeof(values));
    for (float& value : values) value -= kLeast;
    return values;
  }

 private:
  static constexpr int kDropped = 13;  ///< bits of a float's mantissa
  static constexpr std::uint32_t kHalf = 1u << (kDropped - 1);
  static constexpr float kLeast = 0x1p-34f, kMost = 0x1p29f;
  static constexpr std::uint32_t kLeastBits = (127u - 34u) << 23;  ///< of kLeast
  std::uint16_t code_ = 0;
};

/// Each as NodeLight, rounded.
class NodeLights {
 public:
  explicit NodeLights(const std::vector<NodeLight>& nodes) : nodes_(nodes.size()) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const NodeLight& from = nodes[i];
      PackedLight* to = nodes_[i].data();
      for (const Eigen::Array3f& light : {from.irradiance, from.around.above, from.around.below})
        for (Eigen::Index c = 0; c < 3; ++c) *to++ = PackedLight(light[c]);
    }
  }

  std::size_t size() const { return nodes_.size(); }
  NodeLight at(std::size_t node) const {
    const std::array<float, kValues> v = PackedLight::valuesOf<kValues>(nodes_[node].data());
    return {{v[0], v[1], v[2]}, {{v[3], v[4], v[5]}, {v[6], v[7], v[8]}}};
  }
  Eigen::Array3f irradiance(std::size_t node) const {
    const std::array<float, 3> v = PackedLight::valuesOf<3>(nodes_[node].data());
    return {v[0], v[1], v[2]};
  }

 private:
  static constexpr std::size_t kValues = 9;
  using Node = std::array<PackedLight, kValues>;

  std::vector<Node> nodes_;
};

}  // namespace sunlit::light
