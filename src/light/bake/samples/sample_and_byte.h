/// Of a hundred million rays, what each one met.
#pragma once

#include <cstdint>

namespace sunlit::light {

/// The number of a sample, and something about it below 256, in four bytes.
struct SampleAndByte {
  static constexpr std::uint32_t kSampleBits = 24;
  std::uint32_t both;

  static SampleAndByte of(std::uint32_t sample, std::uint32_t byte) { return {byte << kSampleBits | sample}; }
  std::uint32_t sample() const { return both & ((1u << kSampleBits) - 1); }
  std::uint32_t byte() const { return both >> kSampleBits; }
};

}  // namespace sunlit::light
