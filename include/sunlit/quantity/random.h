/// Random numbers that depend on nothing but what they are for.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sunlit {

/// Finaliser of SplitMix64: Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014.
inline std::uint64_t scrambled(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// In [0, 1), of 24 bits.
inline float uniform(std::uint64_t key, std::uint64_t dimension) {
  return static_cast<float>(scrambled(key ^ scrambled(dimension)) >> 40) * 0x1p-24f;
}

/// Seven-dimensional points that fill the cube evenly: a Kronecker sequence by powers of the generalised
/// golden ratio, the root of x^8 = x + 1 (Roberts, "The unreasonable effectiveness of quasirandom sequences",
/// 2018), shifted at random by the key.
struct EvenPoints {
  static constexpr std::size_t kDimensions = 7;
  std::array<double, kDimensions> shift;

  explicit EvenPoints(std::uint64_t key) {
    for (std::size_t d = 0; d < kDimensions; ++d) shift[d] = static_cast<double>(uniform(key, d));
  }
  float at(std::uint32_t index, std::size_t dimension) const {
    static constexpr std::array<double, kDimensions> kStep = {
        0.9115923534820549, 0.8310006189269519, 0.7575338099526643, 0.690562028656977,
        0.629511064928756,  0.5738574732213994, 0.5231240845771608};
    const double value = shift[dimension] + kStep[dimension] * index;
    const auto fraction = static_cast<float>(value - std::floor(value));
    return fraction < 1.0f ? fraction : 0x1.fffffep-1f;
  }
};

}  // namespace sunlit
