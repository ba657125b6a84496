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
  /// Of four, side by side, in vector code: left to themselves, compilers take them apart one by one.
  static Eigen::Array4f valuesOf(const PackedLight* four) {
    using Codes = std::uint16_t __attribute__((vector_size(4 * sizeof(std::uint16_t))));
    using Bits = std::uint32_t __attribute__((vector_size(4 * sizeof(std::uint32_t))));
    static_assert(sizeof(Codes) == 4 * sizeof(PackedLight));
    Codes codes;
    std::memcpy(&codes, four, sizeof(codes));
    const Bits bits = (__builtin_convertvector(codes, Bits) << kDropped) + kLeastBits;
    Eigen::Array4f shifted;
    std::memcpy(shifted.data(), &bits, sizeof(bits));
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
  explicit NodeLights(const std::vector<NodeLight>& nodes) : count_(nodes.size()) {
    values_.reserve(count_ * kValues + 1);
    for (const NodeLight& node : nodes)
      for (const Eigen::Array3f& light : {node.irradiance, node.around.above, node.around.below})
        for (Eigen::Index c = 0; c < 3; ++c) values_.emplace_back(light[c]);
    values_.emplace_back();  // what is read behind the last node
  }

  std::size_t size() const { return count_; }
  /// As NodeLight; the fourth value is of no meaning.
  Eigen::Array4f irradiance(std::size_t node) const { return at(node, 0); }
  Eigen::Array4f above(std::size_t node) const { return at(node, 3); }
  Eigen::Array4f below(std::size_t node) const { return at(node, 6); }

 private:
  static constexpr std::size_t kValues = 9;

  Eigen::Array4f at(std::size_t node, std::size_t first) const {
    return PackedLight::valuesOf(&values_[node * kValues + first]);
  }

  std::size_t count_;
  std::vector<PackedLight> values_;
};

}  // namespace sunlit::light
