/// Inputs that are slightly wrong, made of inputs that are right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sunlit::fuzz {

/// Random numbers that are the same everywhere (SplitMix64; Steele, Lea and Flood 2014).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t roll();
  /// Below `sides` ≥ 1.
  std::size_t below(std::size_t sides) { return static_cast<std::size_t>(roll() % sides); }

 private:
  std::uint64_t state_;
};

/// `input` after one to six slips: of words (exchanged, doubled, left out, taken from one of `others`), of
/// numbers, of bytes, or of its end.
std::string mutated(std::string input, const std::vector<std::string>& others, Dice& dice);

}  // namespace sunlit::fuzz
