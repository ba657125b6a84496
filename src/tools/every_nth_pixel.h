/// A few pixels that stand for all of a large picture.
#pragma once

#include <algorithm>

#include "sunlit/image/images.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::tools {

/// Those in the middle of each square of `step` × `step` pixels.
class EveryNthPixel {
 public:
  explicit EveryNthPixel(int step) : step_(step) {}
  /// The largest step by which a picture that is so wide, or so high, has any.
  static constexpr int largest(int size) { return 2 * size - 1; }

  /// The same picture, in which only these pixels see anything.
  light::Surfaces of(light::Surfaces surfaces) const {
    for (light::Tile& tile : surfaces.tiles) {
      tile.surfaces.erase(std::remove_if(tile.surfaces.begin(), tile.surfaces.end(),
                                         [&](const light::Surface& surface) {
                                           const int pixel = static_cast<int>(surface.pixel);
                                           return !has(pixel % surfaces.width) ||
                                                  !has(pixel / surfaces.width);
                                         }),
                          tile.surfaces.end());
    }
    return surfaces;
  }

  /// These pixels alone, side by side.
  template <typename T, int kChannels>
  image::Picture<T, kChannels> of(const image::Picture<T, kChannels>& picture) const {
    image::Picture<T, kChannels> few(countOf(picture.width), countOf(picture.height));
    for (int y = 0; y < few.height; ++y) {
      for (int x = 0; x < few.width; ++x) {
        std::copy_n(picture.at(first() + x * step_, first() + y * step_), kChannels, few.at(x, y));
      }
    }
    return few;
  }

 private:
  int first() const { return step_ / 2; }
  bool has(int index) const { return index % step_ == first(); }
  int countOf(int size) const { return (size - first() + step_ - 1) / step_; }

  int step_;
};

}  // namespace sunlit::tools
