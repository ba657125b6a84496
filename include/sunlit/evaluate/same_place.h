/// Whether two poses are of one place.
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace sunlit::evaluate {

/// Two poses of one stamp are of one place where they differ by no more than either. Pictures of one pose are
/// compared point by point: what is 5 m away moves by about a pixel of our usual camera (640 px, 60°) for
/// either of these, a third of the 3 px within which a match counts as right. Poses that are sent twice
/// differ by rounding alone, those of two drives along one road by far more.
constexpr double kSamePlace_m = 0.01;
constexpr double kSamePlace_deg = 0.1;

/// What images of a stamp are called in files whose poses are of two places.
inline constexpr const char* kTwoPlaces = "two_places";

/// Empty where these poses of one stamp are of one place, else how far apart they are: "two poses of this
/// stamp are 2.5 m and 10 deg apart: are these two recordings?".
std::string twoPlaces(const Eigen::Isometry3d& first, const Eigen::Isometry3d& second);

}  // namespace sunlit::evaluate
