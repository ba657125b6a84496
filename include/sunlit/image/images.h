/// The pictures that pass between modules, as plain arrays: row-major, top row first, no padding.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunlit::image {

/// A width × height picture of `channels` interleaved values a pixel.
template <typename Value, int kChannels>
struct Picture {
  int width = 0;   ///< px
  int height = 0;  ///< px
  std::vector<Value> data;

  Picture() = default;
  Picture(int width_px, int height_px)
      : width(width_px),
        height(height_px),
        data(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * kChannels) {}
  Value* at(int x, int y) { return data.data() + offset(x, y); }
  const Value* at(int x, int y) const { return data.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           kChannels;
  }
};

using LinearImage = Picture<float, 3>;          ///< linear RGB (see LinearRgb), cd/m²
using Rgb8Image = Picture<std::uint8_t, 3>;     ///< display-referred sRGB, 8 bit
using Grey8Image = Picture<std::uint8_t, 1>;    ///< display-referred luminance, 8 bit
using Grey16Image = Picture<std::uint16_t, 1>;  ///< numbers, such as depth in steps of a length
using DepthImage =
    Picture<float, 1>;  ///< m along the optical axis, or see Lens::wide(); NaN: nothing was hit

/// Whether all of it is 0.
inline bool isBlack(const Rgb8Image& picture) {
  return std::all_of(picture.data.begin(), picture.data.end(), [](std::uint8_t value) { return value == 0; });
}
/// What whoever gets such a picture by day is asked.
constexpr const char* kWhyBlack =
    "does the camera stand in a body or below the ground, are lamps off, or is the exposure for more light "
    "than there is?";

}  // namespace sunlit::image
