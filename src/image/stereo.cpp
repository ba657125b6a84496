#include "sunlit/image/stereo.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sunlit/quantity/range.h"

namespace sunlit::image {
namespace {

/// Files hold as few as six digits.
constexpr double kSame = 1e-5;

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Quaterniond rectification(const Calibration& camera, const std::string& called) {
  const Eigen::Map<const RowMajor3> r(camera.rectification.data());
  const double off = (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (off > kSame || r.determinant() < 0.0)
    refuse(called + "rectification_matrix", "no rotation (its rows are " + textOf(off, 2) + " off)",
           "one to " + textOf(kSame));
  return Eigen::Quaterniond(Eigen::Matrix3d(r)).normalized();
}

std::string placeOfP(std::size_t i) {
  return "projection_matrix[" + std::to_string(i) + "]";
}

void requireSameSize(const PinholeCamera& left, const PinholeCamera& right, const std::string& called) {
  if (right.width != left.width)
    refuse(called + "image_width", std::to_string(right.width),
           std::to_string(left.width) + " as of the left");
  if (right.height != left.height)
    refuse(called + "image_height", std::to_string(right.height),
           std::to_string(left.height) + " as of the left");
}

/// All of P but what tells the two apart: the principal point across, and the baseline.
void requireSameProjection(const Calibration& left, const Calibration& right, const std::string& called) {
  if (!(left.projection[0] > 0.0))
    refuse(called + placeOfP(0) + " of the left", textOf(left.projection[0]), "above 0");
  if (left.projection[3] != 0.0)
    refuse(called + placeOfP(3) + " of the left", textOf(left.projection[3]), "0: is it the right one?");
  for (const std::size_t i : {0, 1, 4, 5, 6, 7, 8, 9, 10, 11}) {
    const double of_left = left.projection[i], of_right = right.projection[i];
    if (std::abs(of_right - of_left) > kSame * std::max(1.0, std::abs(of_left)))
      refuse(called + placeOfP(i), textOf(of_right), textOf(of_left) + " as of the left");
  }
}

}  // namespace

RightCamera calibratedRight(const Calibration& left, const Calibration& right, const std::string& called) {
  requireSameSize(left.camera, right.camera, called);
  requireSameProjection(left, right, called);
  const double baseline_m = 0.0 - right.projection[3] / right.projection[0];  // and not -0
  double unused;
  require(called + "the baseline -P[3] / P[0] of projection_matrix", baseline_m,
          Range::above(0, baselineRow(&unused).range.high), "m");
  const Eigen::Quaterniond turn_of_left = rectification(left, called + "left's "),
                           turn_of_right = rectification(right, called);
  RightCamera placed{right};
  placed.left_from_right.linear() = (turn_of_left.conjugate() * turn_of_right).toRotationMatrix();
  placed.left_from_right.translation() = turn_of_left.conjugate() * Eigen::Vector3d(baseline_m, 0.0, 0.0);
  return placed;
}

RightCamera idealRight(const Calibration& left, double baseline_m, const std::string& called) {
  Calibration right = left;
  right.projection[3] = -baseline_m * left.projection[0];
  return calibratedRight(left, right, called);
}

}  // namespace sunlit::image
