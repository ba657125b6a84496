#include "scene/race_track/course.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunlit::scene::race_track {
namespace {

// The control polygon, to be scaled to m. Start line near the origin, straight to the east, then left round.
constexpr double kControl[][2] = {{-62, 0},   {0, 0},      {62, 0},     {122, -2},   {172, 10},   {190, 55},
                                  {160, 92},  {112, 86},   {80, 70},    {52, 92},    {60, 136},   {92, 160},
                                  {98, 198},  {60, 222},   {8, 214},    {-30, 190},  {-34, 146},  {-54, 108},
                                  {-94, 98},  {-118, 128}, {-148, 156}, {-192, 146}, {-212, 104}, {-196, 66},
                                  {-206, 30}, {-180, 2},   {-126, -4}};
constexpr double kScale = 0.88;
constexpr int kControls = static_cast<int>(sizeof(kControl) / sizeof(kControl[0]));

Eigen::Vector2d control(int i) {
  const int k = ((i % kControls) + kControls) % kControls;
  return kScale * Eigen::Vector2d(kControl[k][0], kControl[k][1]);
}

// Uniform cubic B-spline; the parameter 1 lies by control point 1.
Eigen::Vector2d spline(double parameter) {
  const int i = static_cast<int>(std::floor(parameter));
  const double t = parameter - i;
  const double t2 = t * t;
  const double t3 = t2 * t;
  return ((1 - 3 * t + 3 * t2 - t3) * control(i - 1) + (4 - 6 * t2 + 3 * t3) * control(i) +
          (1 + 3 * t + 3 * t2 - 3 * t3) * control(i + 1) + t3 * control(i + 2)) /
         6.0;
}

}  // namespace

Course::Course() {
  // A fine polyline first, then equal spacing along it.
  constexpr int kFine = 400;
  std::vector<Eigen::Vector2d> fine;
  std::vector<double> along{0.0};
  for (int i = 0; i <= kControls * kFine; ++i) {
    fine.push_back(spline(1.0 + static_cast<double>(i) / kFine));
    if (i > 0) along.push_back(along.back() + (fine[i] - fine[i - 1]).norm());
  }
  length_ = along.back();
  const int count = static_cast<int>(std::lround(length_ / 0.5));
  spacing_ = length_ / count;
  std::size_t k = 0;
  for (int i = 0; i < count; ++i) {
    const double s = i * spacing_;
    while (along[k + 1] < s) ++k;
    const double t = (s - along[k]) / (along[k + 1] - along[k]);
    samples_.push_back({(1 - t) * fine[k] + t * fine[k + 1], Eigen::Vector2d::Zero()});
  }
  for (int i = 0; i < count; ++i) {
    samples_[i].tangent =
        (samples_[(i + 1) % count].point - samples_[(i + count - 1) % count].point).normalized();
  }
}

Course::Sample Course::sample(double along) const {
  const double position = along / spacing_;
  const double floor = std::floor(position);
  const double t = position - floor;
  const long count = static_cast<long>(samples_.size());
  const long i = ((static_cast<long>(floor) % count) + count) % count;
  const Sample& a = samples_[i];
  const Sample& b = samples_[(i + 1) % count];
  return {(1 - t) * a.point + t * b.point, ((1 - t) * a.tangent + t * b.tangent).normalized()};
}

Eigen::Vector2d Course::point(const TrackPlace& place) const {
  const Sample s = sample(place.along);
  return s.point + place.left * leftOf(s.tangent);
}

Eigen::Vector2d Course::tangent(double along) const {
  return sample(along).tangent;
}

double Course::curvature(double along) const {
  constexpr double kReach = 2.0;
  const Eigen::Vector2d a = tangent(along - kReach);
  const Eigen::Vector2d b = tangent(along + kReach);
  return (a.x() * b.y() - a.y() * b.x()) / (2.0 * kReach);
}

TrackPlace Course::nearest(const Eigen::Vector2d& point) const {
  double best = std::numeric_limits<double>::max();
  std::size_t index = 0;
  for (std::size_t i = 0; i < samples_.size(); i += 4) {
    const double d = (samples_[i].point - point).squaredNorm();
    if (d < best) {
      best = d;
      index = i;
    }
  }
  double along = static_cast<double>(index) * spacing_;
  for (int i = 0; i < 3; ++i) {
    const Sample s = sample(along);
    along += std::clamp(s.tangent.dot(point - s.point), -2.0, 2.0);
  }
  const Sample s = sample(along);
  return {along, leftOf(s.tangent).dot(point - s.point)};
}

double Course::drivingLine(double along) const {
  // Towards the inside where it bends, outside before and after: mean curvature over two reaches.
  double near = 0.0;
  double wide = 0.0;
  for (int i = -6; i <= 6; ++i) {
    near += curvature(along + 2.0 * i) / 13.0;
    wide += curvature(along + 6.0 * i) / 13.0;
  }
  return std::clamp(90.0 * near - 55.0 * wide, -2.2, 2.2);
}

const Course& course() {
  static const Course instance;
  return instance;
}

}  // namespace sunlit::scene::race_track
