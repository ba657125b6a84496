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
  float value() const {
    const std::uint32_t bits = (static_cast<std::uint32_t>(code_) << kDropped) + kLeastBits;
    float shifted = 0.0f;
    std::memcpy(&shifted, &bits, sizeof(shifted));
    return shifted - kLeast;
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
      nodes_[i] = {packed(from.irradiance), packed(from.around.above), packed(from.around.below)};
    }
  }

  std::size_t size() const { return nodes_.size(); }
  Eigen::Array3f irradiance(std::size_t node) const { return unpacked(nodes_[node].irradiance); }
  Surroundings around(std::size_t node) const {
    return {unpacked(nodes_[node].above), unpacked(nodes_[node].below)};
  }

 private:
  using Packed = std::array<PackedLight, 3>;
  struct Node {
    Packed irradiance, above, below;
  };
  static Packed packed(const Eigen::Array3f& light) {
    return {PackedLight(light[0]), PackedLight(light[1]), PackedLight(light[2])};
  }
  static Eigen::Array3f unpacked(const Packed& light) {
    return {light[0].value(), light[1].value(), light[2].value()};
  }

  std::vector<Node> nodes_;
};

}  // namespace sunlit::light
