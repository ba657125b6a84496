#include "sunlit/image/vignetting.h"

#include <algorithm>
#include <cmath>

#include "rows.h"
#include "sunlit/quantity/range.h"

namespace sunlit::image {
namespace {

double measured(const VignettingOptions& options, double square) {
  return 1.0 + square * (options.a1 + square * (options.a2 + square * options.a3));
}

double cornerDistance(const PinholeCamera& camera) {
  const double across = std::max(std::abs(camera.cx + 0.5), std::abs(camera.width - 0.5 - camera.cx));
  const double down = std::max(std::abs(camera.cy + 0.5), std::abs(camera.height - 0.5 - camera.cy));
  return std::hypot(across, down);
}

}  // namespace

void validate(const VignettingOptions& options) {
  requireFields(options);
  constexpr int kSteps = 256;
  for (int i = 0; i <= kSteps; ++i) {
    const double r = static_cast<double>(i) / kSteps;
    const double part = measured(options, r * r);
    if (!Range{0.0, 2.0}.contains(part))
      refuse("a1", textOf(options.a1),
             "such that 1 + a1 r² + a2 r⁴ + a3 r⁶ is from 0 to 2 all over the picture; at r = " +
                 textOf(r, 3) + " it is " + textOf(part, 3));
  }
}

Vignetting::Vignetting(const Lens& lens, const VignettingOptions& options)
    : lens_(lens), options_(options), corner_px_(cornerDistance(lens.camera())) {
  validate(options);
  if (none()) return;
  const double widest_deg = lens.widest().deg();
  if (options.cos4 && widest_deg >= 90.0)
    refuse("vignetting", "cos4",
           "none before a lens whose picture shows " + textOf(widest_deg, 3) + " degrees from its axis");
  const PinholeCamera& camera = lens.camera();
  const auto width = static_cast<std::size_t>(camera.width);
  parts_.resize(width * static_cast<std::size_t>(camera.height));
  eachRow(camera.height, [&](int y) {
    float* part = parts_.data() + static_cast<std::size_t>(y) * width;
    for (int x = 0; x < camera.width; ++x) *part++ = static_cast<float>(at({x, y}));
  });
}

double Vignetting::at(const Eigen::Vector2d& pixel) const {
  const PinholeCamera& camera = lens_.camera();
  const double r = (pixel - Eigen::Vector2d(camera.cx, camera.cy)).norm() / corner_px_;
  const double part = measured(options_, r * r);
  if (!options_.cos4) return part;
  const std::optional<Eigen::Vector3d> ray = lens_.unproject(pixel);
  const double cosine = ray ? std::max(0.0, ray->normalized().z()) : 0.0;
  return part * cosine * cosine * cosine * cosine;
}

void Vignetting::apply(LinearImage* picture) const {
  if (parts_.empty()) return;
  const auto width = static_cast<std::size_t>(picture->width);
  eachRow(picture->height, [&](int y) {
    const float* parts = parts_.data() + static_cast<std::size_t>(y) * width;
    float* row = picture->at(0, y);
    for (std::size_t i = 0; i < width; ++i)
      for (std::size_t c = 0; c < 3; ++c) row[3 * i + c] *= parts[i];
  });
}

}  // namespace sunlit::image
