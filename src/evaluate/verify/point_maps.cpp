#include "sunlit/evaluate/verify/point_maps.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "evaluate/files/files.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::evaluate {
namespace {

constexpr const char* kForm = "a homography is three lines of three numbers";

bool isInvertible(const Eigen::Matrix3d& matrix) {
  return matrix.allFinite() && Eigen::FullPivLU<Eigen::Matrix3d>(matrix).isInvertible();
}

bool isWithin(double x, int pixels) {
  return x >= -0.5 && x < pixels - 0.5;
}

PointMap mapInto(const PictureSize& size, const Eigen::Matrix3d& homography) {
  return [=](const Eigen::Vector2d& point) -> std::optional<Eigen::Vector2d> {
    const Eigen::Vector3d seen = homography * point.homogeneous();
    if (!(seen.z() > 0.0)) return std::nullopt;
    const Eigen::Vector2d there = seen.hnormalized();
    if (!isWithin(there.x(), size.width) || !isWithin(there.y(), size.height)) return std::nullopt;
    return there;
  };
}

Eigen::RowVector3d rowOf(const std::string& line) {
  std::istringstream words(line);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    numbers.push_back(parseNumber(word));
    if (!std::isfinite(numbers.back())) throw std::runtime_error(word + " is not finite");
  }
  if (numbers.size() != 3) {
    throw std::runtime_error("numbers of this line: " + std::to_string(numbers.size()) + "; " + kForm);
  }
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

PointMaps homographyMaps(const Eigen::Matrix3d& b_from_a, const PictureSizes& sizes) {
  if (!isInvertible(b_from_a)) throw std::invalid_argument("the homography cannot be inverted");
  const Eigen::Vector3d centre((sizes.a.width - 1) / 2.0, (sizes.a.height - 1) / 2.0, 1.0);
  const double depth = b_from_a.row(2).dot(centre);
  if (depth == 0.0) {
    throw std::invalid_argument("the homography moves the centre of the first picture to infinity");
  }
  const Eigen::Matrix3d forward = depth > 0.0 ? b_from_a : Eigen::Matrix3d(-b_from_a);
  return {mapInto(sizes.b, forward), mapInto(sizes.a, forward.inverse())};
}

PointMaps identityMaps(const PictureSize& size) {
  return homographyMaps(Eigen::Matrix3d::Identity(), {size, size});
}

Eigen::Matrix3d readHomography(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read; " + kForm);
  Eigen::Matrix3d matrix;
  int rows = 0;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    if (++number == 1) line = utf8Of(std::move(line), path);
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    try {
      if (rows == 3) throw std::runtime_error(std::string("a fourth line; ") + kForm);
      matrix.row(rows++) = rowOf(line);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(path + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (file.bad() || rows != 3) {
    throw std::runtime_error(path + ": lines with numbers: " + std::to_string(rows) + "; " + kForm);
  }
  if (!isInvertible(matrix)) throw std::runtime_error(path + ": this homography cannot be inverted");
  return matrix;
}

}  // namespace sunlit::evaluate
