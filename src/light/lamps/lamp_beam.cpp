#include "light/lamps/lamp_beam.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "light/lamps/tube.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

/// Of a cone with a sharp edge, which else would be divided by.
constexpr float kSharpest = 1e-6f;
/// Of cosines, by which a box must lie outside a cone to be known to without a look at the angles.
constexpr float kClearlyOutside = 1e-4f;

/// Of the difference of two squares of cosines: a way along the cone's flank meets it far off or nowhere.
constexpr double kAlongCone = 1e-9;

/// Of a disc that passes light on: near it, light grows as towards a smaller one (the disc's own radius is
/// right on its axis, too large beside it), and its ball stands for what of it shows past things before it.
constexpr float kSoftened = 0.5f, kLeastBall_m = 0.02f, kMostBall_m = 0.5f;
/// The ball's middle lies so many of its radii above the disc: a little clear of unevenness.
constexpr float kRests = 1.1f;

scene::Lamp lampOf(const BouncedLight& light) {
  const float softened_m = kSoftened * light.radius_m;
  scene::Lamp lamp;
  lamp.position = light.position;
  lamp.direction = light.normal;
  lamp.intensity = LinearRgb(light.intensity);
  lamp.constant = softened_m * softened_m;
  lamp.inner_rad = 0.0f;
  lamp.outer_rad = 0.5f * kPiFloat;
  lamp.exponent = 1.0f;
  lamp.radius_m = std::clamp(softened_m, kLeastBall_m, kMostBall_m);
  return lamp;
}

/// Rays that look for a surface end so far before it.
constexpr float kClear_m = 1e-3f;

bool liesFlat(const CompactSource& source) {
  return !source.normal.isZero();
}
bool isLong(const CompactSource& source) {
  return !liesFlat(source) && !source.half.isZero();
}

scene::Lamp lampOf(const CompactSource& source) {
  if (liesFlat(source)) {
    scene::Lamp lamp =
        lampOf(BouncedLight{source.position, source.normal, source.radius_m, source.intensity});
    lamp.radius_m = 0.0f;
    return lamp;
  }
  scene::Lamp lamp;
  lamp.position = source.position;
  lamp.intensity = LinearRgb(source.intensity);
  lamp.radius_m = isLong(source) ? source.uneven_m : source.radius_m;
  lamp.housing_m = isLong(source) ? source.uneven_m + kClear_m : source.reach_m;
  return lamp;
}

/// Of a lamp whose cone falls off linearly or by the square.
struct Falloff {
  Eigen::Vector3f position, axis;
  float constant, linear, quadratic;
  float range_m, per_range, least_m, nearest_m;
  float cos_outer, per_cosine;
  bool squares;
};

SUNLIT_WIDE_VECTOR_CLONES
void sharesOf(const Falloff& lamp, const LampBeam::Points& points, float* __restrict shares) {
  const float lamp_x = lamp.position.x(), lamp_y = lamp.position.y(), lamp_z = lamp.position.z();
  const float axis_x = lamp.axis.x(), axis_y = lamp.axis.y(), axis_z = lamp.axis.z();
  const float constant = lamp.constant, linear = lamp.linear, quadratic = lamp.quadratic;
  const float range_m = lamp.range_m, per_range = lamp.per_range;
  const float least_m = lamp.least_m, nearest_m = lamp.nearest_m;
  const float cos_outer = lamp.cos_outer, per_cosine = lamp.per_cosine;
  const bool squares = lamp.squares;
  for (std::size_t i = 0; i < points.count; ++i) {
    const float x = points.x[i] - lamp_x, y = points.y[i] - lamp_y, z = points.z[i] - lamp_z;
    const float distance_m = std::sqrt(x * x + y * y + z * z);
    const float d = std::max(distance_m, least_m);
    const float cosine = (axis_x * x + axis_y * y + axis_z * z) / std::max(distance_m, nearest_m);
    const float edge = std::min(std::max((cosine - cos_outer) * per_cosine, 0.0f), 1.0f);
    const float part = distance_m * per_range, square = part * part;
    const float faded = std::max(1.0f - square * square, 0.0f);
    const float share = faded * edge * (squares ? edge : 1.0f) / (constant + d * (linear + d * quadratic));
    shares[i] = distance_m <= range_m ? share : 0.0f;
  }
}

}  // namespace

LampBeam::LampBeam(const scene::Lamp& lamp)
    : lamp_(lamp),
      ball_(lamp.position),
      shown_radius_m_(lamp.radius_m),
      brightest_(lamp.intensity.value.maxCoeff()),
      least_m_(std::max(lamp.radius_m, kNearest_m)),
      per_range_(lamp.ends_sharply ? 0.0f : 1.0f / lamp.range_m),
      cos_outer_(std::cos(lamp.outer_rad)),
      per_cosine_(1.0f / std::max(std::cos(lamp.inner_rad) - cos_outer_, kSharpest)) {}

LampBeam::LampBeam(const BouncedLight& light) : LampBeam(lampOf(light)) {
  ball_ = light.position + kRests * lamp_.radius_m * light.normal;
  shown_radius_m_ = light.radius_m;
  kind_ = Kind::kBounced;
}

LampBeam::LampBeam(const CompactSource& source) : LampBeam(lampOf(source)) {
  shown_radius_m_ = source.radius_m;
  if (liesFlat(source)) {
    kind_ = source.round ? Kind::kEllipse : Kind::kRectangle;
    half_ = source.half;
    ball_ = source.position + (source.uneven_m + kClear_m) * source.normal;  // rays end before it
  } else if (isLong(source)) {
    kind_ = Kind::kTube;
    half_ = source.half;
    least_shape_ = 0.0f;  // none beyond its ends
  } else {
    kind_ = Kind::kBody;
    shape_ = source.shape;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(shape_, Eigen::EigenvaluesOnly);
    least_shape_ = std::sqrt(std::max(axes.eigenvalues()[0], 0.0f));
  }
}

Eigen::Vector3f LampBeam::onTube(const Eigen::Vector3f& towards, const Eigen::Vector2f& point) const {
  const Eigen::Vector3f axis = half_.col(0).normalized(), inwards = towards - axis.dot(towards) * axis;
  const float size = inwards.norm();
  if (!(size > 0.0f)) return half_.col(0) * point.x();  // seen along it: nothing of it is
  return half_.col(0) * point.x() + inwards.cross(axis) * (lamp_.radius_m * point.y() / size) -
         inwards * (lamp_.housing_m / size);
}

Eigen::Vector3f LampBeam::lightOfTube(const Eigen::Vector3f& point) const {
  const float half_m = half_.col(0).norm();
  const Eigen::Vector3f axis = half_.col(0) / half_m, way = lamp_.position - point;
  const float along_m = way.dot(axis);
  const Eigen::Vector3f nearest = way - along_m * axis;
  const float away_m = std::max(nearest.norm(), least_m_);
  const TubeLight light = tubeLight(away_m, along_m - half_m, along_m + half_m);
  return (light.across / away_m * nearest + light.along * axis) / (2.0f * half_m);
}

Eigen::Vector3f LampBeam::towards(const Eigen::Vector3f& point) const {
  return (isTube() ? lightOfTube(point) : Eigen::Vector3f(lamp_.position - point)).normalized();
}

LampBeam::Bounds LampBeam::within(const Eigen::AlignedBox3f& box) const {
  const Eigen::Vector3f middle = box.center() - lamp_.position;
  const float radius = 0.5f * box.diagonal().norm(), distance = middle.norm();
  const float nearest =
      std::max(box.exteriorDistance(lamp_.position) - (isTube() ? half_.norm() : 0.0f), 0.0f);
  const float farthest = distance + radius;
  if (nearest > lamp_.range_m) return {0.0f, 0.0f};
  if (lamp_.isSpot() && distance > radius) {
    // Most boxes see nothing of most lamps: known by the cosine of the angle to the axis less the ball's.
    const float cosine = lamp_.direction.dot(middle) / distance, sine = radius / distance;
    const float cos_ball = std::sqrt(1.0f - sine * sine);
    const float nearest_cosine = cosine * cos_ball + std::sqrt(std::max(1.0f - cosine * cosine, 0.0f)) * sine;
    if (cosine < cos_ball && nearest_cosine < cos_outer_ - kClearlyOutside) return {0.0f, 0.0f};
  }
  // The angles to the axis that the ball around the box covers.
  float least = 0.0f, most = kPiFloat;
  if (lamp_.isSpot() && distance > radius) {
    const float angle = std::acos(std::clamp(lamp_.direction.dot(middle) / distance, -1.0f, 1.0f));
    const float spread = std::asin(radius / distance);
    least = std::max(angle - spread, 0.0f);
    most = std::min(angle + spread, kPiFloat);
  }
  const float low = farthest > lamp_.range_m ? 0.0f : attenuation(farthest) * cone(std::cos(most));
  return {brightest_ * least_shape_ * low, brightest_ * attenuation(nearest) * cone(std::cos(least))};
}

LampBeam::Stretch LampBeam::withinCone(const Eigen::Vector3f& start, const Eigen::Vector3f& towards) const {
  constexpr float kFar_m = std::numeric_limits<float>::infinity();
  const Stretch all{-kFar_m, kFar_m}, nothing{0.0f, 0.0f};
  if (!isSpot() || cos_outer_ <= 0.0f) return all;
  // (axis · p)² − cos² |p|² = a s² + 2 b s + c, p from the lamp: not below 0 in the cone and its mirror
  // image.
  const Eigen::Vector3d axis = lamp_.direction.cast<double>(), way = towards.cast<double>();
  const Eigen::Vector3d from = start.cast<double>() - lamp_.position.cast<double>();
  const double square = static_cast<double>(cos_outer_) * static_cast<double>(cos_outer_);
  const double along = axis.dot(way), before = axis.dot(from);
  const double a = along * along - square, b = before * along - square * from.dot(way),
               c = before * before - square * from.squaredNorm();
  const double root = std::sqrt(std::max(b * b - a * c, 0.0));
  if (std::abs(a) < kAlongCone) return all;
  const auto near_m = static_cast<float>(std::min((-b - root) / a, (-b + root) / a)),
             far_m = static_cast<float>(std::max((-b - root) / a, (-b + root) / a));
  if (a > 0.0) return along > 0.0 ? Stretch{far_m, kFar_m} : Stretch{-kFar_m, near_m};
  const bool mirrored = before - b / a * along < 0.0;
  return root > 0.0 && !mirrored ? Stretch{near_m, far_m} : nothing;
}

void LampBeam::shares(const Points& points, float* shares) const {
  constexpr float kSquare = 2.0f, kLinear = 1.0f;
  if (isTube() || (lamp_.isSpot() && lamp_.exponent != kSquare && lamp_.exponent != kLinear)) {
    for (std::size_t i = 0; i < points.count; ++i) shares[i] = share({points.x[i], points.y[i], points.z[i]});
    return;
  }
  // Of one that shines all around every cosine lies in the cone.
  sharesOf({lamp_.position, lamp_.direction, lamp_.constant, lamp_.linear, lamp_.quadratic, lamp_.range_m,
            per_range_, least_m_, kNearest_m, lamp_.isSpot() ? cos_outer_ : -3.0f,
            lamp_.isSpot() ? per_cosine_ : 1.0f, lamp_.exponent == kSquare},
           points, shares);
  if (kind_ != Kind::kBody) return;
  for (std::size_t i = 0; i < points.count; ++i)
    shares[i] *= shape(Eigen::Vector3f(points.x[i], points.y[i], points.z[i]) - lamp_.position);
}

}  // namespace sunlit::light
