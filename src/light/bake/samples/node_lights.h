/// The light of all nodes of a bake, in half of the memory.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>
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
  std::uint16_t code_;                                             // not set: see NodeLights
};

/// Sets the light of nodes [first, end).
using FindLight = std::function<void(std::size_t first, std::size_t end, NodeLight* light)>;

/// Of each node, rounded. It is found, with that of its neighbours, when it is first asked for: pictures show
/// few of them. May be asked by many threads.
class NodeLights {
 public:
  /// `find` is called by many threads, once at most for each node, and must not throw.
  NodeLights(std::size_t count, FindLight find)
      : count_(count),
        find_(std::move(find)),
        states_(blocks()),
        values_(new PackedLight[blocks() * kOfBlock]) {}

  std::size_t size() const { return count_; }
  /// As NodeLight; the fourth value is of no meaning.
  Eigen::Array4f irradiance(std::size_t node) const { return at(node, 0); }
  Eigen::Array4f above(std::size_t node) const { return at(node, 3); }
  Eigen::Array4f below(std::size_t node) const { return at(node, 6); }

 private:
  static constexpr std::size_t kValues = 9;
  static constexpr std::size_t kBlock = 32;                      ///< nodes that are found together
  static constexpr std::size_t kOfBlock = kBlock * kValues + 1;  ///< with what is read behind the last node
  enum State : std::uint8_t { kUnknown, kBeingFound, kFound };

  std::size_t blocks() const { return (count_ + kBlock - 1) / kBlock; }
  Eigen::Array4f at(std::size_t node, std::size_t first) const {
    const std::size_t block = node / kBlock;
    if (states_[block].load(std::memory_order_acquire) != kFound) find(block);
    return PackedLight::valuesOf(&values_[block * kOfBlock + node % kBlock * kValues + first]);
  }
  void find(std::size_t block) const;

  std::size_t count_;
  FindLight find_;
  mutable std::vector<std::atomic<std::uint8_t>> states_;  ///< of each block
  std::unique_ptr<PackedLight[]> values_;  ///< of each block; memory that nobody has touched is none
};

}  // namespace sunlit::light
