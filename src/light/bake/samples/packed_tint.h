/// Colours of light that has come through tinted glass, for hundreds of millions of rays.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace sunlit::light {

/// What a colour is for luminance 1, in two bytes: within 1 % in red and 1.3 % in blue, where these are not
/// below a thirtieth of white's. White is exact.
class PackedTint {
 public:
  PackedTint() = default;
  /// Of a colour of any luminance; white for none.
  explicit PackedTint(const Eigen::Array3f& color);

  friend bool operator==(PackedTint a, PackedTint b) { return a.red_ == b.red_ && a.blue_ == b.blue_; }
  bool white() const { return red_ == kWhiteRed && blue_ == kWhiteBlue; }
  /// Of luminance 1.
  Eigen::Array3f value() const;
  /// Such light where `color` of it is left.
  Eigen::Array3f times(const Eigen::Array3f& color) const {
    return white() ? color : Eigen::Array3f(color * value());
  }

 private:
  struct Scales;
  /// Logarithms, such that pure red of luminance 1, which is 4.7, and pure blue, 13.9, are the last ones.
  static constexpr std::uint8_t kWhiteRed = 178, kWhiteBlue = 150;

  std::uint8_t red_ = kWhiteRed, blue_ = kWhiteBlue;  ///< 0: none of it
};

/// One of `tints`; white where there are none, as in all that has no tinted glass.
template <typename Tints>
PackedTint tintOf(const Tints& tints, std::size_t number) {
  return tints.empty() ? PackedTint() : tints[number];
}

}  // namespace sunlit::light
