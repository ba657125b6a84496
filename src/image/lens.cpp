#include "sunlit/image/lens.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sunlit/quantity/range.h"

namespace sunlit::image {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Steps in which the fold is looked for, rad.
constexpr double kFoldStep = 1e-3;
constexpr int kBisections = 60;
constexpr int kNewtonSteps = 50;
/// How far from a point of the bent plane its solution may be taken to.
constexpr double kSolved = 1e-11;
/// Points along each side of a picture at which its edge is looked at.
constexpr int kEdgePoints = 128;

bool isWide(LensModel model) {
  return model == LensModel::kEquidistant || model == LensModel::kOmni;
}

}  // namespace

std::vector<std::string> lensModelNames() {
  return {"plumb_bob", "rational_polynomial", "equidistant", "omni"};
}

std::string nameOf(LensModel model) {
  return lensModelNames()[static_cast<std::size_t>(model)];
}

bool Distortion::none() const {
  const bool zeros = std::all_of(coefficients.begin(), coefficients.end(), [](double k) { return k == 0.0; });
  return zeros && !isWide(model);
}

void requireCoefficients(const Distortion& distortion, const std::string& called) {
  const std::size_t count = distortion.coefficients.size();
  const auto requireCount = [&](bool good, const std::string& allowed) {
    if (!good)
      refuse(called, std::to_string(count) + (count == 1 ? " number" : " numbers"),
             allowed + " for " + nameOf(distortion.model));
  };
  switch (distortion.model) {
    case LensModel::kPlumbBob:
      requireCount(count == 4 || count == 5, "4 or 5, k1 k2 p1 p2 [k3],");
      break;
    case LensModel::kRationalPolynomial:
      requireCount(count == 8, "8, k1 k2 p1 p2 k3 k4 k5 k6,");
      break;
    case LensModel::kEquidistant:
      requireCount(count == 4, "4, k1 k2 k3 k4,");
      break;
    case LensModel::kOmni:
      requireCount(count == 5, "5, xi k1 k2 p1 p2,");
      break;
  }
  for (const double coefficient : distortion.coefficients) require(called, coefficient, {-1e6, 1e6});
  if (distortion.model == LensModel::kOmni)
    require(called + " (xi)", distortion.coefficients[0], Range::atLeast(0.0));
}

Lens::Lens(const PinholeCamera& camera, const Distortion& distortion)
    : camera_(camera), distortion_(distortion), wide_(isWide(distortion.model)) {
  requireCoefficients(distortion, "distortion_coefficients");
  const std::vector<double>& k = distortion.coefficients;
  switch (distortion.model) {
    case LensModel::kPlumbBob:
    case LensModel::kRationalPolynomial:
      above_ = {k[0], k[1], k.size() > 4 ? k[4] : 0.0, 0.0};
      p1_ = k[2];
      p2_ = k[3];
      if (k.size() > 5) below_ = {k[5], k[6], k[7]};
      break;
    case LensModel::kEquidistant:
      above_ = {k[0], k[1], k[2], k[3]};
      break;
    case LensModel::kOmni:
      xi_ = k[0];
      above_ = {k[1], k[2], 0.0, 0.0};
      p1_ = k[3];
      p2_ = k[4];
      break;
  }
  findFold();
}

double Lens::planeRadius(double theta) const {
  if (!wide_) return theta < 0.5 * kPi ? std::tan(theta) : kInfinite;
  if (distortion_.model == LensModel::kEquidistant) return theta;
  return std::sin(theta) / (std::cos(theta) + xi_);
}

Eigen::Vector3d Lens::direction(const Eigen::Vector2d& m) const {
  if (!wide_) return {m.x(), m.y(), 1.0};
  const double r = m.norm();
  if (distortion_.model == LensModel::kEquidistant) {
    const double across = r > 1e-12 ? std::sin(r) / r : 1.0;
    return {across * m.x(), across * m.y(), std::cos(r)};
  }
  // The point s · (m, 1) − (0, ξ) of the unit sphere; of the two, the one before the fold.
  const double root = std::sqrt(std::max(0.0, 1.0 + (1.0 - xi_ * xi_) * r * r));
  const double s = (xi_ + root) / (1.0 + r * r);
  return {s * m.x(), s * m.y(), s - xi_};
}

Lens::Bent Lens::bend(const Eigen::Vector2d& m) const {
  const double x = m.x(), y = m.y(), q = m.squaredNorm();
  const double above = 1.0 + q * (above_[0] + q * (above_[1] + q * (above_[2] + q * above_[3])));
  const double below = 1.0 + q * (below_[0] + q * (below_[1] + q * below_[2]));
  const double above_slope = above_[0] + q * (2.0 * above_[1] + q * (3.0 * above_[2] + q * 4.0 * above_[3]));
  const double below_slope = below_[0] + q * (2.0 * below_[1] + q * 3.0 * below_[2]);
  const double scale = above / below;
  const double scale_slope = 2.0 * (above_slope - scale * below_slope) / below;  // of q / 2
  Bent bent;
  bent.at = {x * scale + 2.0 * p1_ * x * y + p2_ * (q + 2.0 * x * x),
             y * scale + p1_ * (q + 2.0 * y * y) + 2.0 * p2_ * x * y};
  const double mixed = x * y * scale_slope + 2.0 * p1_ * x + 2.0 * p2_ * y;
  bent.slope << scale + x * x * scale_slope + 2.0 * p1_ * y + 6.0 * p2_ * x, mixed, mixed,
      scale + y * y * scale_slope + 6.0 * p1_ * y + 2.0 * p2_ * x;
  return bent;
}

double Lens::bentRadius(double r) const {
  const double q = r * r;
  return r * (1.0 + q * (above_[0] + q * (above_[1] + q * (above_[2] + q * above_[3])))) /
         (1.0 + q * (below_[0] + q * (below_[1] + q * below_[2])));
}

/// 0 and below beyond the fold, also where the polynomial below the line has passed a root.
double Lens::bentSlope(double r) const {
  const double q = r * r;
  const double above = 1.0 + q * (above_[0] + q * (above_[1] + q * (above_[2] + q * above_[3])));
  const double below = 1.0 + q * (below_[0] + q * (below_[1] + q * below_[2]));
  if (!(below > 0.0)) return -1.0;
  const double above_slope = above_[0] + q * (2.0 * above_[1] + q * (3.0 * above_[2] + q * 4.0 * above_[3]));
  const double below_slope = below_[0] + q * (2.0 * below_[1] + q * 3.0 * below_[2]);
  return (above + 2.0 * q * (above_slope - above / below * below_slope)) / below;
}

void Lens::findFold() {
  const double end = wide_ ? kPi : 0.5 * kPi;
  const auto rises = [&](double theta) {
    if (distortion_.model == LensModel::kOmni) {
      const double cosine = std::cos(theta);
      if (!(cosine + xi_ > 0.0) || !(1.0 + xi_ * cosine > 0.0)) return false;
    }
    return bentSlope(planeRadius(theta)) > 0.0;
  };
  double good = 0.0, bad = kFoldStep;
  while (bad < end && rises(bad)) {
    good = bad;
    bad += kFoldStep;
  }
  if (bad >= end) {
    fold_ = Angle::radians(end);
    fold_radius_ = distortion_.model == LensModel::kEquidistant ? end : planeRadius(good);
    if (!wide_) fold_radius_ = kInfinite;
    return;
  }
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (good + bad);
    (rises(middle) ? good : bad) = middle;
  }
  fold_ = Angle::radians(good);
  fold_radius_ = planeRadius(good);
}

/// On the plane, of what `bent` would be without p1 and p2; at most the fold.
double Lens::straightRadius(double bent) const {
  double low = 0.0, high = std::min(fold_radius_, std::max(bent, 1e-6));
  while (high < fold_radius_ && bentRadius(high) < bent && high < 1e9) {
    low = high;
    high = std::min(2.0 * high, fold_radius_);
  }
  if (!(bentRadius(high) > bent)) return high;
  double r = 0.5 * (low + high);
  for (int i = 0; i < kBisections; ++i) {
    const double off = bentRadius(r) - bent;
    (off > 0.0 ? high : low) = r;
    if (std::abs(off) <= kSolved * (1.0 + bent)) break;
    const double next = r - off / bentSlope(r);
    r = next > low && next < high ? next : 0.5 * (low + high);
  }
  return r;
}

std::optional<Eigen::Vector2d> Lens::project(const Eigen::Vector3d& point) const {
  const double across = point.head<2>().norm();
  const double theta = std::atan2(across, point.z());
  if (!(theta < fold_.rad()) || (!wide_ && !(point.z() > 0.0))) return std::nullopt;
  Eigen::Vector2d m = Eigen::Vector2d::Zero();
  if (!wide_) {
    m = point.head<2>() / point.z();
  } else if (across > 0.0) {
    m = point.head<2>() * (planeRadius(theta) / across);
  }
  const Eigen::Vector2d bent = bend(m).at;
  return Eigen::Vector2d(camera_.fx * bent.x() + camera_.cx, camera_.fy * bent.y() + camera_.cy);
}

std::optional<Eigen::Vector3d> Lens::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d wanted((pixel.x() - camera_.cx) / camera_.fx, (pixel.y() - camera_.cy) / camera_.fy);
  const double radius = wanted.norm();
  if (radius < 1e-15) return direction(wanted);
  Eigen::Vector2d m = wanted * (straightRadius(radius) / radius);
  double best = kInfinite;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Bent bent = bend(m);
    const Eigen::Vector2d off = bent.at - wanted;
    const double distance = off.norm();
    // Until rounding is all that is left of it.
    if (distance == 0.0 || (distance < kSolved * (1.0 + radius) && !(distance < 0.5 * best))) break;
    best = distance;
    if (!(bent.slope.determinant() > 0.0)) return std::nullopt;
    m -= bent.slope.inverse() * off;
    if (!m.allFinite()) return std::nullopt;
  }
  const Bent bent = bend(m);
  const bool solved = (bent.at - wanted).norm() < kSolved * (1.0 + radius);
  if (!solved || !(m.norm() < fold_radius_) || !(bent.slope.determinant() > 0.0)) return std::nullopt;
  return direction(m);
}

Angle Lens::acrossWidth() const {
  const auto angleAt = [&](double x) {  // to the right
    const std::optional<Eigen::Vector3d> ray = unproject({x, camera_.cy});
    return ray ? std::atan2(ray->x(), ray->z()) : std::copysign(fold_.rad(), x - camera_.cx);
  };
  return Angle::radians(angleAt(camera_.width - 0.5) - angleAt(-0.5));
}

Angle Lens::widest() const {
  const double right = camera_.width - 0.5, bottom = camera_.height - 0.5;
  const auto fold = [&] {
    return textOf(fold_.deg(), 3) + " degrees from the axis, where the " + nameOf(distortion_.model) +
           " of distortion_coefficients ends or folds back";
  };
  double widest = 0.0;
  for (int i = 0; i <= kEdgePoints; ++i) {
    const double along = static_cast<double>(i) / kEdgePoints;
    const double x = -0.5 + along * (right + 0.5), y = -0.5 + along * (bottom + 0.5);
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(x, -0.5), Eigen::Vector2d(x, bottom),
                                         Eigen::Vector2d(-0.5, y), Eigen::Vector2d(right, y)}) {
      const std::optional<Eigen::Vector3d> ray = unproject(pixel);
      if (!ray) {
        throw std::invalid_argument("the picture is " + std::to_string(camera_.width) + " x " +
                                    std::to_string(camera_.height) + " px, but its pixel (" +
                                    textOf(pixel.x(), 6) + ", " + textOf(pixel.y(), 6) +
                                    ") lies beyond what the lens shows: " + fold());
      }
      widest = std::max(widest, std::atan2(ray->head<2>().norm(), ray->z()));
    }
  }
  require("the picture's widest angle from the axis", widest / kRadPerDeg, {0.0, kWidest_deg}, "deg");
  return Angle::radians(widest);
}

}  // namespace sunlit::image
