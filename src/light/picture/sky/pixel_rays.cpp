#include "sunlit/light/pixel_rays.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sunlit::light {
namespace {

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

PixelRays::PixelRays(const image::Lens& lens) : lens_(lens) {
  const int width = lens.camera().width, height = lens.camera().height;
  const auto nodes = std::make_shared<std::vector<Eigen::Vector3f>>(static_cast<std::size_t>(width) *
                                                                    static_cast<std::size_t>(height));
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x)
      (*nodes)[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
          lens.unproject({x, y}).value().cast<float>();
  });
  nodes_ = nodes;
  first_ = nodes_->data();
  findWidest();
}

PixelRays::PixelRays(const PixelRays& whole, const image::Lens& rows, int first)
    : lens_(rows), nodes_(whole.nodes_), first_(whole.row(first)) {
  findWidest();
}

void PixelRays::findWidest() {
  const int width = lens_.camera().width, height = lens_.camera().height;
  std::vector<double> widest(static_cast<std::size_t>(height), 0.0);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const double across = angleBetween(at(x - 0.5, y), at(x + 0.5, y));
      const double along = angleBetween(at(x, y - 0.5), at(x, y + 0.5));
      double& most = widest[static_cast<std::size_t>(y)];
      most = std::max(most, std::hypot(across, along));
    }
  });
  widest_pixel_ = *std::max_element(widest.begin(), widest.end());
}

Eigen::Vector3d PixelRays::at(double x, double y) const {
  const int left = std::clamp(static_cast<int>(std::floor(x)), 0, lens_.camera().width - 2);
  const int top = std::clamp(static_cast<int>(std::floor(y)), 0, lens_.camera().height - 2);
  const double right = x - left, down = y - top;
  const auto along = [&](int row) {
    const Eigen::Vector3d from = node(left, row).cast<double>();
    return Eigen::Vector3d(from + right * (node(left + 1, row).cast<double>() - from));
  };
  const Eigen::Vector3d above = along(top);
  return above + down * (along(top + 1) - above);
}

}  // namespace sunlit::light
