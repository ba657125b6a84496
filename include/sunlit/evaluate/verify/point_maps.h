/// Where a point of one picture lies in another: the truth that features are checked against.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

namespace sunlit::evaluate {

/// Takes a point of one picture to the point of another that shows the same place, both finite, in px; the
/// centre of the top left pixel is (0, 0). None where the other picture does not show the place or nobody
/// knows: such a point is outside the common part of both. Must give the same each time, and may be called by
/// several threads at once.
using PointMap = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d&)>;

/// Both ways between the pictures a and b.
struct PointMaps {
  PointMap b_from_a;
  PointMap a_from_b;
};

/// In px; both at least 1.
struct PictureSize {
  int width = 0;
  int height = 0;
};

struct PictureSizes {
  PictureSize a;
  PictureSize b;
};

/// What a camera sees of a plane, or sees when it only turns: (u, v, w) = H (x, y, 1) is shown at (u/w, v/w)
/// (Hartley & Zisserman, *Multiple View Geometry*, 2nd ed. 2004, definition 2.11). The common part is what
/// lies, mapped, within the other picture: x from −0.5 to less than width − 0.5, and y likewise.
///
/// `b_from_a` may have any scale. What lies beyond its vanishing line, as seen from the centre of a, is
/// behind the other camera and in no common part. Throws std::invalid_argument unless it is finite and
/// invertible and keeps the centre of a off that line.
PointMaps homographyMaps(const Eigen::Matrix3d& b_from_a, const PictureSizes& sizes);

/// The same, where both pictures are taken from one pose by one camera: each point stays where it is.
PointMaps identityMaps(const PictureSize& size);

/// Three lines of three numbers each, apart by blanks; empty lines and those that begin with # do not count.
/// Throws std::runtime_error with path, line and what is wrong, also for a matrix that cannot be inverted.
Eigen::Matrix3d readHomography(const std::string& path);

}  // namespace sunlit::evaluate
