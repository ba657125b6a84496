/// Where the pixels of a lens look.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/image/lens.h"

namespace sunlit::light {

class PixelRays {
 public:
  /// `lens` shows all of its picture, see image::Lens::widest(), but for less than half a pixel at its edge.
  explicit PixelRays(const image::Lens& lens);

  const image::Lens& lens() const { return lens_; }
  /// In the optical frame, as image::Lens::unproject(): that of the middle of each pixel, between them
  /// linear, and outside of the picture as it goes on from its edge.
  Eigen::Vector3d at(double x, double y) const;
  /// Of a pixel to the right and down, about (x, y).
  Eigen::Vector3d right(double x, double y) const { return at(x + 0.5, y) - at(x - 0.5, y); }
  Eigen::Vector3d down(double x, double y) const { return at(x, y + 0.5) - at(x, y - 0.5); }
  /// The greatest angle, rad, that a pixel spans from corner to corner.
  double widestPixel() const { return widest_pixel_; }

 private:
  const Eigen::Vector3f& node(int x, int y) const {
    return nodes_[static_cast<std::size_t>(y) * static_cast<std::size_t>(lens_.camera().width) +
                  static_cast<std::size_t>(x)];
  }

  image::Lens lens_;
  std::vector<Eigen::Vector3f> nodes_;  ///< of the middles of pixels, by rows
  double widest_pixel_ = 0.0;
};

}  // namespace sunlit::light
