#include "sunlit/image/veiling_glare.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "finite_luminance.h"
#include "glare_wings.h"
#include "rows.h"
#include "sunlit/image/mean_luminance.h"

namespace sunlit::image {
namespace {

/// A light fades over so much at least, also where the picture shows as much as the hood lets in, or more.
constexpr double kLeastFade_deg = 5.0;

double fromAxis_rad(const Eigen::Vector3d& ray) {
  return std::acos(std::clamp(ray.z() / ray.norm(), -1.0, 1.0));
}

/// Of a light that has passed the edge, both from the axis, rad: what is left of it.
double fadedPart(double light, double edge, double hood) {
  const double end = std::max(hood, edge + kLeastFade_deg * kRadPerDeg);
  if (!(light < end)) return 0.0;
  // Lenses that show nearly a half-space and more have fronts that face to the side.
  const double facing = std::max(0.0, edge + (kLeastFade_deg - 90.0) * kRadPerDeg);
  return (end - light) / (end - edge) * std::max(0.0, std::cos(light - facing) / std::cos(edge - facing));
}

/// sr
double solidAngleAt(const Lens& lens, const Eigen::Vector2d& pixel, const Eigen::Vector3d& ray) {
  // Of a hundredth of a pixel, which lies in the picture's direction of any edge as well as beside it.
  constexpr double kStep = 0.01;
  const auto right = lens.unproject(pixel + Eigen::Vector2d(kStep, 0.0));
  const auto down = lens.unproject(pixel + Eigen::Vector2d(0.0, kStep));
  if (!right || !down) return 0.0;
  Eigen::Matrix3d sides;
  sides << (*right - ray) / kStep, (*down - ray) / kStep, ray;
  return std::abs(sides.determinant()) / std::pow(ray.norm(), 3);
}

}  // namespace

void validate(const GlareOptions& options) {
  requireFields(options);
}

VeilingGlare::VeilingGlare(const Vignetting& vignetting, const GlareOptions& options)
    : vignetting_(vignetting), options_(options) {
  validate(options);
}

/// The pixel at the edge of the picture on the way from its middle to where `towards` would lie.
Eigen::Vector2d VeilingGlare::edgeTowards(const Eigen::Vector3d& towards) const {
  const PinholeCamera& camera = vignetting_.lens().camera();
  const Eigen::Vector2d last(camera.width - 1.0, camera.height - 1.0);
  const Eigen::Vector2d middle = Eigen::Vector2d(camera.cx, camera.cy).cwiseMax(0.0).cwiseMin(last);
  const Eigen::Vector2d way(camera.fx * towards.x(), camera.fy * towards.y());
  double reach = way.isZero() ? 0.0 : 1e300;
  for (int i = 0; i < 2; ++i) {
    if (way[i] > 0.0) reach = std::min(reach, (last[i] - middle[i]) / way[i]);
    if (way[i] < 0.0) reach = std::min(reach, -middle[i] / way[i]);
  }
  return middle + reach * way;
}

LinearRgb VeilingGlare::meanOf(const LightOutside& light) const {
  const Lens& lens = vignetting_.lens();
  const Eigen::Vector2d pixel = edgeTowards(light.towards);
  const std::optional<Eigen::Vector3d> ray = lens.unproject(pixel);
  if (!ray) return {};
  const double edge = fromAxis_rad(*ray), angle = fromAxis_rad(light.towards);
  const double part = angle > edge ? fadedPart(angle, edge, options_.hood.rad()) : 1.0;
  const double solid_angle = solidAngleAt(lens, pixel, *ray);
  if (part == 0.0 || !(solid_angle > 0.0)) return {};
  const double pixels = static_cast<double>(lens.camera().width) * lens.camera().height;
  return light.illuminance * static_cast<float>(part * vignetting_.at(pixel) / (solid_angle * pixels));
}

WingsFromBeyond VeilingGlare::wingsOf(const LightOutside& light, const LinearRgb& mean) const {
  const Lens& lens = vignetting_.lens();
  const PinholeCamera& camera = lens.camera();
  const Eigen::Vector2d edge = edgeTowards(light.towards);
  const std::optional<Eigen::Vector3d> ray = lens.unproject(edge);
  const double edge_rad = ray ? fromAxis_rad(*ray) : 0.0;
  const double away_rad = std::max(fromAxis_rad(light.towards) - edge_rad, 0.0);
  const float pixels = static_cast<float>(camera.width) * static_cast<float>(camera.height);
  return {edge, away_rad * std::sqrt(camera.fx * camera.fy), pixels * mean.value};
}

void VeilingGlare::apply(const std::vector<LightOutside>& outside, LinearImage* picture) const {
  if (none()) return;
  for (float& value : picture->data) value = finiteLuminance(value);
  const auto share = static_cast<float>(options_.share), wings = static_cast<float>(options_.wings);
  Eigen::Array3d even = (1.0 - options_.wings) * meanLuminance(*picture);
  LinearImage with_wings;
  if (wings > 0.0f) with_wings = glareWings(*picture);
  for (const LightOutside& light : outside) {
    const LinearRgb mean = meanOf(light);
    double evenly = 1.0;
    if (wings > 0.0f) evenly += options_.wings * (addWings(wingsOf(light, mean), &with_wings) - 1.0);
    even += evenly * mean.value.cast<double>();
  }
  const Eigen::Array3f veil = (options_.share * even).cast<float>();
  const LinearImage& blurred = wings > 0.0f ? with_wings : *picture;
  eachRow(picture->height, [&](int y) {
    float* pixel = picture->at(0, y);
    const float* wing = blurred.at(0, y);
    for (int x = 0; x < picture->width; ++x, pixel += 3, wing += 3)
      for (int c = 0; c < 3; ++c) pixel[c] = (1.0f - share) * pixel[c] + share * wings * wing[c] + veil[c];
  });
}

}  // namespace sunlit::image
