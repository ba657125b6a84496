/// What one lamp, or a surface that passes light on, gives where nothing is in the way.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sunlit/light/lamps.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

class LampBeam {
 public:
  /// `lamp` is not relative.
  explicit LampBeam(const scene::Lamp& lamp);
  /// Gives I cos / (r² / 4 + d²), the cosine that of the angle to the disc's normal, r its radius.
  explicit LampBeam(const BouncedLight& light);
  /// The same of a flat one; of a body I / d², by its shape; of a tube that of a line (tubeLight()).
  explicit LampBeam(const CompactSource& source);

  const Eigen::Vector3f& position() const { return lamp_.position; }
  /// The ball that rays look for: of a lamp about position(); of a surface it rests on that, so that rays end
  /// before it and not below.
  const Eigen::Vector3f& ball() const { return ball_; }
  float radius_m() const { return lamp_.radius_m; }
  /// What lies nearer, such as its bulb, is part of it and hides nothing.
  float spared_m() const { return std::max(lamp_.radius_m, lamp_.housing_m); }
  /// From ball() to a point of the unit disc across the way there, which the unit vector `towards` tells; of
  /// a flat source to one of its own, of a tube to one before the side of it that is seen.
  Eigen::Vector3f aside(const Eigen::Vector3f& towards, const Eigen::Vector2f& point) const {
    if (isTube()) return onTube(towards, onSquare(point));
    if (isFlat()) return half_ * (kind_ == Kind::kEllipse ? point : onSquare(point));
    return across(towards) * (lamp_.radius_m * point);
  }
  /// What is aside() on the other side of the middle of a flat source or a tube.
  Eigen::Vector3f turnedOver(const Eigen::Vector3f& aside) const {
    if (!isTube()) return -aside;
    return aside - half_.col(0) * (2.0f * half_.col(0).dot(aside) / half_.col(0).squaredNorm());
  }
  /// How large it shows in surfaces that mirror it.
  float shownRadius_m() const { return shown_radius_m_; }
  bool isBounced() const { return kind_ == Kind::kBounced; }
  /// Whether what mirrors by rays meets it there.
  bool isSurface() const { return kind_ != Kind::kLamp; }
  bool isFlat() const { return kind_ == Kind::kRectangle || kind_ == Kind::kEllipse; }
  bool isTube() const { return kind_ == Kind::kTube; }
  /// Of a tube: from its middle to an end, along its axis; and how thick it is.
  Eigen::Vector3f halfLength() const { return half_.col(0); }
  float tubeRadius_m() const { return least_m_; }
  /// Of a flat source: CompactSource::normal, and half of the rectangle that is as large.
  const Eigen::Vector3f& normal() const { return lamp_.direction; }
  Eigen::Matrix<float, 3, 2> half() const {
    return (kind_ == Kind::kEllipse ? std::sqrt(kPiFloat / 4.0f) : 1.0f) * half_;
  }
  bool isSpot() const { return lamp_.isSpot(); }
  bool castsShadows() const { return lamp_.casts_shadows; }

  /// Illuminance of a plane at `point` that faces the lamp, lx. Within the lamp's ball: as on its surface.
  Eigen::Array3f at(const Eigen::Vector3f& point) const { return lamp_.intensity.value * share(point); }

  /// Unit vector from there to where that light comes from in sum.
  Eigen::Vector3f towards(const Eigen::Vector3f& point) const;

  /// Between these lies the largest channel of at() of all points of a box, whatever is in the way.
  struct Bounds {
    float low, high;
  };
  Bounds within(const Eigen::AlignedBox3f& box) const;

  /// Distances along a way from `start`, m, between which it runs within the lamp's cone: beyond them the
  /// lamp gives nothing. `towards` is a unit vector. Of a cone wider than a right angle, whose outside they
  /// could not tell: all.
  struct Stretch {
    float from, to;
  };
  Stretch withinCone(const Eigen::Vector3f& start, const Eigen::Vector3f& towards) const;

  /// Two unit vectors at right angles to the unit vector `towards` and to each other, the same for equal
  /// `towards`: the disc that the lamp's ball shows lies across them.
  static Eigen::Matrix<float, 3, 2> across(const Eigen::Vector3f& towards);

  /// at() in parts of intensity(), and its largest channel in parts of brightest().
  float share(const Eigen::Vector3f& point) const;
  /// Points side by side.
  struct Points {
    const float *x, *y, *z;
    std::size_t count;
  };
  /// share() of each of them, within rounding.
  void shares(const Points& points, float* shares) const;
  const Eigen::Array3f& intensity() const { return lamp_.intensity.value; }
  float brightest() const { return brightest_; }

 private:
  enum class Kind { kLamp, kBounced, kRectangle, kEllipse, kBody, kTube };  ///< from the third on: compact

  /// Of a lamp that is a point: where 1 / d² would grow without end.
  static constexpr float kNearest_m = 1e-3f;
  /// By distance, up to the range.
  float attenuation(float distance_m) const;
  /// By the cosine of the angle to the axis.
  float cone(float cosine) const;
  /// The square around the unit disc, evenly, by points that fill the disc evenly (Shirley & Chiu, "A low
  /// distortion map between disk and square", 1997, the other way).
  static Eigen::Vector2f onSquare(const Eigen::Vector2f& disc) {
    const bool steep = std::abs(disc.y()) > std::abs(disc.x());
    const float longer = steep ? disc.y() : disc.x(), shorter = steep ? disc.x() : disc.y();
    if (longer == 0.0f) return disc;
    const float edge = std::copysign(disc.norm(), longer);
    const float along = edge * std::atan(shorter / longer) * (4.0f / kPiFloat);
    return steep ? Eigen::Vector2f(along, edge) : Eigen::Vector2f(edge, along);
  }
  Eigen::Vector3f onTube(const Eigen::Vector3f& towards, const Eigen::Vector2f& point) const;
  /// Of a tube at `point`: share(), as a vector towards it.
  Eigen::Vector3f lightOfTube(const Eigen::Vector3f& point) const;
  /// Of a body: by the way from it, of any length.
  float shape(const Eigen::Vector3f& away) const {
    const float square = away.squaredNorm();
    return square > 0.0f ? std::sqrt(std::max(away.dot(shape_ * away) / square, 0.0f)) : 1.0f;
  }

  scene::Lamp lamp_;
  Eigen::Vector3f ball_;
  float shown_radius_m_;
  Kind kind_ = Kind::kLamp;
  Eigen::Matrix<float, 3, 2> half_ = Eigen::Matrix<float, 3, 2>::Zero();  ///< and this: as of CompactSource
  Eigen::Matrix3f shape_ = Eigen::Matrix3f::Identity();
  float least_shape_ = 1.0f;  ///< of shape(), to any side
  float brightest_;
  float least_m_;    ///< nearer than that nothing gets brighter
  float per_range_;  ///< 1/m, of one that fades towards its range; else 0
  float cos_outer_, per_cosine_;
};

inline Eigen::Matrix<float, 3, 2> LampBeam::across(const Eigen::Vector3f& towards) {
  // At right angles to the vertical, or where it hardly tells, to the x axis.
  const float x = towards.x(), y = towards.y(), z = towards.z();
  Eigen::Matrix<float, 3, 2> axes;
  if (std::abs(z) < 0.9f) {
    const float per = 1.0f / std::sqrt(x * x + y * y);
    axes.col(0) = Eigen::Vector3f(-y * per, x * per, 0.0f);
  } else {
    const float per = 1.0f / std::sqrt(y * y + z * z);
    axes.col(0) = Eigen::Vector3f(0.0f, -z * per, y * per);
  }
  axes.col(1) = towards.cross(axes.col(0));
  return axes;
}

inline float LampBeam::attenuation(float distance_m) const {
  const float d = std::max(distance_m, least_m_);
  const float part = distance_m * per_range_, square = part * part;
  return std::max(1.0f - square * square, 0.0f) / (lamp_.constant + d * (lamp_.linear + d * lamp_.quadratic));
}

inline float LampBeam::cone(float cosine) const {
  if (!lamp_.isSpot()) return 1.0f;
  const float edge = std::clamp((cosine - cos_outer_) * per_cosine_, 0.0f, 1.0f);
  if (edge <= 0.0f || edge >= 1.0f) return edge;
  return lamp_.exponent == 2.0f ? edge * edge : std::pow(edge, lamp_.exponent);  // 2: of glTF
}

inline float LampBeam::share(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f away = point - lamp_.position;
  if (isTube()) return lightOfTube(point).norm();
  const float distance_m = away.norm();
  if (distance_m > lamp_.range_m) return 0.0f;
  return (kind_ == Kind::kBody ? shape(away) : 1.0f) * attenuation(distance_m) *
         cone(lamp_.direction.dot(away) / std::max(distance_m, kNearest_m));
}

}  // namespace sunlit::light
