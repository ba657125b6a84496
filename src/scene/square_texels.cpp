#include "scene/square_texels.h"

#include <algorithm>

namespace sunlit::scene {

image::Rgba8Image withSquares(const image::Rgba8Image& picture) {
  constexpr int kLargest = 16;
  const int side =
      std::clamp(2 * kLongestOfSquares / std::max({picture.width, picture.height, 1}), 1, kLargest);
  image::Rgba8Image squares(side * picture.width, side * picture.height);
  for (int y = 0; y < squares.height; ++y) {
    for (int x = 0; x < squares.width; ++x) std::copy_n(picture.at(x / side, y / side), 4, squares.at(x, y));
  }
  return squares;
}

}  // namespace sunlit::scene
