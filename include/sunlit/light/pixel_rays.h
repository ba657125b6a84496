/// Where the pixels of a lens look.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sunlit/image/lens.h"

namespace sunlit::light {

class PixelRays {
 public:
  /// `lens` shows all of its picture, see image::Lens::widest(), but for less than half a pixel at its edge.
  explicit PixelRays(const image::Lens& lens);
  /// Of `rows`, the lens of some rows of the picture of `whole` from `first` on, two at least: keeps no rays
  /// of its own, but goes on from its own edges.
  PixelRays(const PixelRays& whole, const image::Lens& rows, int first);

  const image::Lens& lens() const { return lens_; }
  /// In the optical frame, as image::Lens::unproject(): that of the middle of each pixel, between them
  /// linear, and outside of the picture as it goes on from its edge.
  Eigen::Vector3d at(double x, double y) const;
  /// Of a pixel to the right and down, about (x, y).
  Eigen::Vector3d right(double x, double y) const { return at(x + 0.5, y) - at(x - 0.5, y); }
  Eigen::Vector3d down(double x, double y) const { return at(x, y + 0.5) - at(x, y - 0.5); }
  /// The greatest angle, rad, that a pixel spans from corner to corner.
  double widestPixel() const { return widest_pixel_; }
  /// At the middles of the pixels of row `y`, from left to right, then those of the rows below it; as long as
  /// this, or one made of it, is there.
  const Eigen::Vector3f* row(int y) const { return &node(0, y); }

 private:
  const Eigen::Vector3f& node(int x, int y) const {
    return first_[static_cast<std::size_t>(y) * static_cast<std::size_t>(lens_.camera().width) +
                  static_cast<std::size_t>(x)];
  }
  void findWidest();

  image::Lens lens_;
  std::shared_ptr<const std::vector<Eigen::Vector3f>> nodes_;  ///< of the middles of pixels, by rows
  const Eigen::Vector3f* first_;                               ///< of these, the upper left one here
  double widest_pixel_ = 0.0;
};

}  // namespace sunlit::light
