#include "sunlit/image/veiling_glare.h"

#include <Eigen/Geometry>
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

Eigen::Vector2d axisOf(const PinholeCamera& camera) {
  return {camera.cx, camera.cy};
}

Eigen::Vector2d lastOf(const PinholeCamera& camera) {
  return {camera.width - 1.0, camera.height - 1.0};
}

bool showsAxis(const PinholeCamera& camera) {
  const Eigen::Array2d axis = axisOf(camera), last = lastOf(camera);
  return (axis >= 0.0).all() && (axis <= last).all();
}

/// From the axis towards where a light would lie, px.
Eigen::Vector2d wayTo(const PinholeCamera& camera, const Eigen::Vector3d& towards) {
  return {camera.fx * towards.x(), camera.fy * towards.y()};
}

/// The pixel at the edge of a picture that shows its axis, on the way from there to a light.
Eigen::Vector2d edgeFromAxis(const PinholeCamera& camera, const Eigen::Vector3d& towards) {
  const Eigen::Vector2d axis = axisOf(camera), last = lastOf(camera), way = wayTo(camera, towards);
  double reach = way.isZero() ? 0.0 : 1e300;
  for (int i = 0; i < 2; ++i) {
    if (way[i] > 0.0) reach = std::min(reach, (last[i] - axis[i]) / way[i]);
    if (way[i] < 0.0) reach = std::min(reach, -axis[i] / way[i]);
  }
  return axis + reach * way;
}

/// Of a light that lies between the middles of a picture's pixels.
std::optional<Eigen::Vector2d> pixelOf(const Lens& lens, const Eigen::Vector3d& towards) {
  const std::optional<Eigen::Vector2d> pixel = lens.project(towards);
  if (!pixel) return std::nullopt;
  const Eigen::Array2d last = lastOf(lens.camera()), at = *pixel;
  return (at >= 0.0).all() && (at <= last).all() ? pixel : std::nullopt;
}

/// The pixel nearest to where a light would lie. Other pictures are not on the way from their axis to it, or
/// only behind it.
Eigen::Vector2d nearestTo(const Lens& lens, const Eigen::Vector3d& towards) {
  constexpr double kFar_px = 1e9;
  const PinholeCamera& camera = lens.camera();
  const Eigen::Vector2d far = axisOf(camera) + kFar_px * wayTo(camera, towards).normalized();
  return lens.project(towards).value_or(far).cwiseMax(0.0).cwiseMin(lastOf(camera));
}

}  // namespace

void validate(const GlareOptions& options) {
  requireFields(options);
}

VeilingGlare::VeilingGlare(const Vignetting& vignetting, const GlareOptions& options)
    : vignetting_(vignetting), options_(options) {
  validate(options);
}

VeilingGlare::Passed VeilingGlare::passedBy(const Eigen::Vector3d& towards) const {
  const Lens& lens = vignetting_.lens();
  const bool shows_axis = showsAxis(lens.camera());
  const std::optional<Eigen::Vector2d> inside = pixelOf(lens, towards);
  Passed edge;
  edge.pixel = inside       ? *inside
               : shows_axis ? edgeFromAxis(lens.camera(), towards)
                            : nearestTo(lens, towards);
  edge.ray = lens.unproject(edge.pixel);
  if (!edge.ray) return edge;
  edge.edge_rad = edge.light_rad = fromAxis_rad(*edge.ray);
  if (inside) return edge;
  if (shows_axis)
    edge.light_rad = fromAxis_rad(towards);
  else
    edge.light_rad += std::atan2(edge.ray->cross(towards).norm(), edge.ray->dot(towards));
  return edge;
}

LinearRgb VeilingGlare::meanOf(const LightOutside& light) const {
  const Passed edge = passedBy(light.towards);
  if (!edge.ray) return {};
  const bool has_passed = edge.light_rad > edge.edge_rad;
  const double part = has_passed ? fadedPart(edge.light_rad, edge.edge_rad, options_.hood.rad()) : 1.0;
  const double solid_angle = solidAngleAt(vignetting_.lens(), edge.pixel, *edge.ray);
  if (part == 0.0 || !(solid_angle > 0.0)) return {};
  const PinholeCamera& camera = vignetting_.lens().camera();
  const double pixels = static_cast<double>(camera.width) * camera.height;
  return light.illuminance * static_cast<float>(part * vignetting_.at(edge.pixel) / (solid_angle * pixels));
}

WingsFromBeyond VeilingGlare::wingsOf(const LightOutside& light, const LinearRgb& mean) const {
  const PinholeCamera& camera = vignetting_.lens().camera();
  const Passed edge = passedBy(light.towards);
  const double away_rad = std::max(edge.light_rad - edge.edge_rad, 0.0);
  const float pixels = static_cast<float>(camera.width) * static_cast<float>(camera.height);
  return {edge.pixel, away_rad * std::sqrt(camera.fx * camera.fy), pixels * mean.value};
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
