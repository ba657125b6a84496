/// The points on a distant disc that the pixels of a picture cast their rays to.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

namespace sunlit::light {

/// Each pixel has 16 points that fill the disc evenly, in four quads: so do the four points of a quad,
/// roughly, each in a quarter of its own, at another distance from the middle. Any 2 × 2 pixels start with
/// four different quads, any four rows have their points turned differently: the first quads of neighbours
/// make up 16 points, those of 4 × 4 pixels 64. The same for every block of 4 × 4 pixels: points at random
/// would be grain that clings to the screen, and feature detectors find grain.
class DiscPoints {
 public:
  static constexpr std::size_t kPoints = 16, kQuad = 4;

  /// About the unit vector `towards`, of angular radius `radius_rad`; of what is above the horizon.
  DiscPoints(const Eigen::Vector3f& towards, float radius_rad);
  /// The same disc as a level mirror of that `alpha` (see Ggx) shows it: below the horizon, and as far aside
  /// as its facets, leaning, turn it.
  static DiscPoints inFloor(const Eigen::Vector3f& towards, float radius_rad, float alpha);

  /// Unit vectors at right angles to the way to the disc and to each other.
  const Eigen::Vector3f& across() const { return across_; }
  const Eigen::Vector3f& up() const { return up_; }

  /// Towards the points of the pixel in column x and row y, in the order of their use.
  class OfPixel {
   public:
    const Eigen::Vector3f& operator[](std::size_t i) const { return points_[i ^ first_]; }

   private:
    friend class DiscPoints;
    OfPixel(const std::array<Eigen::Vector3f, kPoints>& points, std::size_t first)
        : points_(points), first_(first) {}
    const std::array<Eigen::Vector3f, kPoints>& points_;
    std::size_t first_;
  };
  OfPixel ofPixel(std::size_t x, std::size_t y) const {
    // Which point of its quad comes first, and is often the only one, differs among 16 pixels of a row: a
    // thin shadow along the row, of a wire, hides but a strip of the disc.
    return {directions_[y % kPeriod][x % kPeriod], (x / 2 + x / 8 + y / 2) % kQuad};
  }

 private:
  static constexpr std::size_t kPeriod = 4;
  /// `alpha` 0: of the disc itself.
  DiscPoints(const Eigen::Vector3f& towards, float radius_rad, float alpha);

  Eigen::Vector3f across_, up_;
  std::array<std::array<std::array<Eigen::Vector3f, kPoints>, kPeriod>, kPeriod> directions_;
};

}  // namespace sunlit::light
