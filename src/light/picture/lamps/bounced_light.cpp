#include "light/picture/lamps/bounced_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "light/geometry/ray_list.h"
#include "light/lamps/lamp_beam.h"
#include "light/picture/lamps/power_rays.h"
#include "light/shading/glass_sheets.h"
#include "light/shading/mirrored_by_rays.h"
#include "light/shading/shading.h"
#include "light/shading/vertex.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// Of all lamps together, but at least so many of each.
constexpr std::size_t kRays = 2048, kLeastRays = 128, kGroups = 12, kLeastGroups = 4;
/// What is further from the lamp, or from the plane through it, is told apart no more.
constexpr float kFar_m = 16.0f, kDeep_m = 4.0f;
/// Lamps of a body so near each other that shine alike, such as a pair of headlights, share their groups.
constexpr float kPair_m = 0.5f, kParallel = 0.99f;
/// Of the light that is passed on: a place with less than twice that hands some of it to one for all groups,
/// with less than that all.
constexpr float kFaint = 0.01f;

/// Of light that a surface passes on where a ray met it.
struct Bounce {
  Eigen::Vector3f position, normal;
  Eigen::Array3f lumens;
  float area_m2;  ///< of the surface, that the ray stands for
};

/// Which bounces are taken together. Each finds it by itself: were it by what others met, many would change
/// over at once.
struct Place {
  std::uint32_t lamp, group;  ///< of a pair the first one
  int octave;                 ///< of the distance to the lamp
  int facing;                 ///< which axis of `map` the normal is nearest to
  int depth;  ///< octave of how far the lamp stands before the surface, by that axis: a table, the floor
              ///< below
  bool operator<(const Place& o) const {
    return std::tie(lamp, group, octave, facing, depth) <
           std::tie(o.lamp, o.group, o.octave, o.facing, o.depth);
  }
};

int octaveOf(float metres, float farthest_m) {
  constexpr float kNearest_m = 0.0625f;
  return static_cast<int>(std::floor(std::log2(std::clamp(metres, kNearest_m, farthest_m))));
}

class Sum {
 public:
  void add(const Bounce& bounce, float share) {
    const Eigen::Array3f lumens = share * bounce.lumens;
    const auto weight = static_cast<double>(lumens.sum());
    const Eigen::Vector3d position = bounce.position.cast<double>();
    lumens_ += lumens;
    weight_ += weight;
    position_ += weight * position;
    square_ += weight * position.squaredNorm();
    normal_ += weight * bounce.normal.cast<double>();
    area_ += weight * static_cast<double>(bounce.area_m2);
  }
  float weight() const { return static_cast<float>(weight_); }
  /// A disc as wide as the bounces lie apart. Empty if they face all ways.
  std::optional<BouncedLight> light() const {
    const Eigen::Vector3d middle = position_ / weight_;
    const double length = normal_.norm() / weight_;
    if (!(length > 1e-3)) return std::nullopt;
    // The mean square distance to its middle is half the square of a disc's radius.
    const double scatter = std::max(square_ / weight_ - middle.squaredNorm(), 0.0);
    const double radius_m = std::sqrt(2.0 * scatter + area_ / weight_ / kPi);
    return BouncedLight{middle.cast<float>(), normal_.normalized().cast<float>(),
                        std::max(static_cast<float>(radius_m), 1e-3f), lumens_ / kPiFloat};
  }

 private:
  Eigen::Array3f lumens_ = Eigen::Array3f::Zero();
  double weight_ = 0.0, square_ = 0.0, area_ = 0.0;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), normal_ = Eigen::Vector3d::Zero();
};

class Bounces {
 public:
  explicit Bounces(const Visibility& visibility)
      : visibility_(visibility),
        vertices_(visibility.fixedGeometry(), visibility.movingGeometry()),
        glass_(visibility) {}

  /// Those of a lamp whose frame, z along its axis, is `map_from_lamp`. `number`: of Place.
  void add(const scene::Lamp& lamp, std::uint32_t number, const Eigen::Matrix3f& map_from_lamp,
           const PowerRays& rays) {
    lamp_ = lamp;
    number_ = number;
    each_sr_ = rays.each_sr;
    list_.clear();
    list_.reserve(rays.directions.size());
    for (std::size_t i = 0; i < rays.directions.size(); ++i) {
      const Eigen::Vector3f direction = map_from_lamp * rays.directions[i];
      // What lies within the lamp's ball is part of it.
      list_.add(rays.groups[i], lamp.position + lamp.radius_m * direction, direction);
    }
    hits_.resize(list_.size());
    visibility_.closest(list_.rays(), hits_.data());
    for (std::size_t i = 0; i < hits_.size(); ++i)
      if (hits_[i].triangle != Hit::kMiss) meet(i);
  }

  std::vector<BouncedLight> lights() const {
    float all = 0.0f;
    for (const auto& [place, bounce] : bounces_) all += bounce.lumens.sum();
    std::map<Place, Sum> places;
    for (const auto& [place, bounce] : bounces_) places[place].add(bounce, 1.0f);
    std::map<Place, float> kept;
    for (const auto& [place, sum] : places)
      kept[place] = std::clamp(sum.weight() / (kFaint * all) - 1.0f, 0.0f, 1.0f);
    std::map<Place, Sum> sums;
    for (const auto& [place, bounce] : bounces_) {
      const float share = kept[place];
      if (share > 0.0f) sums[place].add(bounce, share);
      if (share < 1.0f) sums[aroundOf(place)].add(bounce, 1.0f - share);
    }
    std::vector<BouncedLight> lights;
    for (const auto& [place, sum] : sums) {
      if (!(sum.weight() > 0.0f)) continue;
      if (const std::optional<BouncedLight> light = sum.light()) lights.push_back(*light);
    }
    return lights;
  }

 private:
  /// Where faint ones of all directions are taken together: such as a thin edge.
  static Place aroundOf(Place place) {
    constexpr std::uint32_t kAllGroups = 0xffffffffu;
    place.group = kAllGroups;
    return place;
  }

  void meet(std::size_t i) {
    const Rays rays = list_.rays();
    const Eigen::Vector3f origin(rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]);
    const Eigen::Vector3f direction(rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]);
    const Vertex vertex = vertices_.at(hits_[i], direction);
    Eigen::Array3f lumens = brought(hits_[i].distance + lamp_.radius_m);
    if (glass_.any()) lumens *= glass_.through({origin, direction, 0.0f, hits_[i].distance});
    const Reflection& reflection = vertex.reflection;
    const AmbientReflectance by = ambientReflectance(reflection);
    const float mirrored = reflection.transmission > 0.0f ? 0.0f : kSmoothOnes.share(reflection.roughness);
    const float distance_m = hits_[i].distance + lamp_.radius_m;
    const float cosine = std::max(std::abs(vertex.geometric_normal.dot(direction)), 0.1f);
    const float area_m2 = each_sr_ * distance_m * distance_m / cosine;
    keep(i, {vertex.front, vertex.geometric_normal,
             lumens * (by.diffuse * kPiFloat + (1.0f - mirrored) * by.specular), area_m2});
    keep(i, {vertex.behind, -vertex.geometric_normal, lumens * by.through * kPiFloat, area_m2});
  }

  /// By one ray to a surface at that distance, lm.
  Eigen::Array3f brought(float distance_m) const {
    scene::Lamp all_around = lamp_;  // rays lie as dense as the cone gives light
    all_around.inner_rad = all_around.outer_rad = scene::Lamp::kAllAround_rad;
    const Eigen::Vector3f point = lamp_.position + distance_m * Eigen::Vector3f::UnitX();
    return LampBeam(all_around).at(point) * (distance_m * distance_m * each_sr_);
  }

  void keep(std::size_t i, const Bounce& bounce) {
    if (!(bounce.lumens.maxCoeff() > 0.0f)) return;
    Eigen::Index axis = 0;
    bounce.normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Vector3f away = bounce.position - lamp_.position;
    const int facing = 2 * static_cast<int>(axis) + (bounce.normal[axis] > 0.0f ? 1 : 0);
    bounces_.emplace_back(Place{number_, list_.number()[i], octaveOf(away.norm(), kFar_m), facing,
                                octaveOf(std::abs(away[axis]), kDeep_m)},
                          bounce);
  }

  const Visibility& visibility_;
  SceneVertices vertices_;
  GlassSheets glass_;
  std::vector<std::pair<Place, Bounce>> bounces_;  ///< of all lamps so far
  scene::Lamp lamp_;                               ///< and the others: of the one that is being added
  std::uint32_t number_ = 0;
  float each_sr_ = 0.0f;
  RayList list_;
  std::vector<Hit> hits_;
};

bool arePair(const BodyLamp& a, const BodyLamp& b) {
  return a.body == b.body && a.lamp.inner_rad == b.lamp.inner_rad && a.lamp.outer_rad == b.lamp.outer_rad &&
         a.lamp.exponent == b.lamp.exponent && a.lamp.direction.dot(b.lamp.direction) > kParallel &&
         (a.lamp.position - b.lamp.position).norm() < kPair_m;
}

/// Place::lamp of each.
std::vector<std::uint32_t> numbersOf(const std::vector<BodyLamp>& lamps) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < lamps.size(); ++i) {
    std::uint32_t first = 0;
    while (!arePair(lamps[first], lamps[i]) && first < i) ++first;
    numbers.push_back(first);
  }
  return numbers;
}

}  // namespace

std::vector<BouncedLight> bouncedLight(const std::vector<BodyLamp>& lamps,
                                       const std::vector<Eigen::Isometry3d>& map_from_body,
                                       const Visibility& visibility) {
  if (lamps.empty()) return {};
  const std::vector<std::uint32_t> numbers = numbersOf(lamps);
  const std::size_t different = std::set<std::uint32_t>(numbers.begin(), numbers.end()).size();
  const std::size_t rays = std::max(kRays / lamps.size(), kLeastRays),
                    groups = std::max(kGroups / different, kLeastGroups);
  Bounces bounces(visibility);
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const scene::Lamp& lamp = lamps[i].lamp;
    const Eigen::Isometry3d& place = map_from_body[lamps[i].body];
    Eigen::Matrix3f body_from_lamp;
    body_from_lamp << LampBeam::across(lamp.direction), lamp.direction;
    bounces.add(placed(lamp, place), numbers[i], place.linear().cast<float>() * body_from_lamp,
                powerRays(lamp, rays, groups));
  }
  return bounces.lights();
}

}  // namespace sunlit::light
