#include "light/picture/lights_outside.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "light/geometry/ray_list.h"
#include "light/lamps/lamp_beam.h"
#include "light/patches/even_directions.h"
#include "light/picture/disc/disc_points.h"
#include "light/picture/sky/pixel_of_direction.h"
#include "light/shading/glass_sheets.h"
#include "light/shading/vertex.h"
#include "sunlit/light/lamps.h"

namespace sunlit::light {
namespace {

/// Rows of DiscPoints, each turned otherwise: with 64 points in all a disc that goes behind an edge, or out
/// of the picture, does so in steps of 2 %.
constexpr std::size_t kRows = 4;

/// What glows so near to a lamp's ball is its bulb.
constexpr float kBulb_m = 0.5f;
constexpr std::size_t kBulbRays = 64;

/// By which pictures show lamps.
class Bulbs {
 public:
  /// Keeps references.
  Bulbs(const Visibility& visibility, const std::vector<scene::Lamp>& burning)
      : visibility_(visibility),
        vertices_(visibility.fixedGeometry(), visibility.movingGeometry()),
        burning_(burning) {}

  /// Whether `beam` has one: whoever looks from where, so that none comes and goes.
  bool has(const LampBeam& beam) const {
    static const std::vector<Eigen::Vector3f> all_around = evenDirections(kBulbRays);
    return std::any_of(all_around.begin(), all_around.end(), [&](const Eigen::Vector3f& towards) {
      // From the far side of the ball: also of a lamp that lies on its bulb.
      RayList ray;
      ray.reserve(1);
      ray.add(0, beam.ball() - beam.radius_m() * towards, towards);
      Hit hit;
      visibility_.closest(ray.rays(), &hit);
      return hit.triangle != Hit::kMiss && hit.distance <= 2.0f * beam.radius_m() + kBulb_m &&
             glows(vertices_.material(hit), burning_);
    });
  }

 private:
  const Visibility& visibility_;
  SceneVertices vertices_;
  const std::vector<scene::Lamp>& burning_;
};

class Outside {
 public:
  Outside(const Surfaces& surfaces, const Visibility& visibility, float nearest_m)
      : surfaces_(surfaces),
        visibility_(visibility),
        glass_(visibility),
        nearest_m_(nearest_m),
        pixels_(surfaces) {}

  /// Of sun or moon, as they shine on the camera.
  void add(const sky::DiscLight& disc) {
    if (!(disc.illuminance.value.maxCoeff() > 0.0f)) return;
    const Eigen::Vector3f middle = disc.towards.vector().cast<float>();
    const DiscPoints points(middle, static_cast<float>(disc.angular_radius.rad()));
    RayList rays;
    std::vector<Eigen::Vector3f> ways;
    rays.reserve(kRows * DiscPoints::kPoints);
    for (std::size_t row = 0; row < kRows; ++row) {
      const DiscPoints::OfPixel of_row = points.ofPixel(0, row);
      for (std::size_t i = 0; i < DiscPoints::kPoints; ++i) {
        const Eigen::Vector3f towards = of_row[i].normalized();
        if (inPicture(towards)) continue;
        rays.add(0, surfaces_.eye + nearest_m_ * towards, towards);
        ways.push_back(towards);
      }
    }
    if (ways.empty()) return;
    std::vector<std::uint8_t> blocked(ways.size());
    visibility_.occluded(rays.rays(), blocked.data(), Visibility::Blends::kLetPass);
    Eigen::Array3f open = Eigen::Array3f::Zero();
    for (std::size_t i = 0; i < ways.size(); ++i)
      if (blocked[i] == 0) open += through(ways[i], std::numeric_limits<float>::infinity());
    const Eigen::Array3f share = open / static_cast<float>(kRows * DiscPoints::kPoints);
    add(middle, LinearRgb(disc.illuminance.value * share));
  }

  /// Small enough to be seen whole or not at all.
  void add(const scene::Lamp& lamp, const Bulbs& bulbs) {
    const LampBeam beam(lamp);
    const Eigen::Array3f lx = beam.at(surfaces_.eye);
    const Eigen::Vector3f way = beam.ball() - surfaces_.eye;
    const float distance_m = way.norm(), open_m = distance_m - beam.radius_m();
    if (!(lx.maxCoeff() > 0.0f) || !(open_m > nearest_m_)) return;
    const Eigen::Vector3f towards = way / distance_m;
    if (hidden(towards, open_m)) {
      // A lamp may shine through its own bulb, but is not seen through walls, whatever it lights behind them.
      if (beam.castsShadows() || hidden(towards, open_m - kBulb_m) || !bulbs.has(beam)) return;
    }
    // There its bulb has its light.
    if (inPicture(towards) && bulbs.has(beam)) return;
    add(towards, LinearRgb(lx * through(towards, open_m)));
  }

  std::vector<image::LightOutside> take() { return std::move(lights_); }

 private:
  void add(const Eigen::Vector3f& towards, const LinearRgb& illuminance) {
    if (illuminance.value.maxCoeff() > 0.0f)
      lights_.push_back({surfaces_.map_from_optical.transpose() * towards.cast<double>(), illuminance});
  }
  bool inPicture(const Eigen::Vector3f& towards) const {
    const std::optional<PixelOfDirection::Place> place = pixels_.at(towards.cast<double>());
    if (!place) return false;
    const Eigen::Vector2d& pixel = place->pixel;
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < surfaces_.width - 0.5 &&
           pixel.y() < surfaces_.height - 0.5;
  }
  /// What veils leave of light that nothing stops.
  Eigen::Array3f through(const Eigen::Vector3f& towards, float distance_m) const {
    return glass_.throughVeils({surfaces_.eye, towards, nearest_m_, distance_m});
  }
  bool hidden(const Eigen::Vector3f& towards, float distance_m) const {
    if (!(distance_m > nearest_m_)) return false;
    RayList ray;
    ray.reserve(1);
    ray.add(0, surfaces_.eye + nearest_m_ * towards, (distance_m - nearest_m_) * towards);
    std::uint8_t blocked = 0;
    visibility_.occludedWithin(ray.rays(), &blocked, Visibility::Blends::kLetPass);
    return blocked != 0;
  }

  const Surfaces& surfaces_;
  const Visibility& visibility_;
  GlassSheets glass_;
  float nearest_m_;
  PixelOfDirection pixels_;
  std::vector<image::LightOutside> lights_;
};

}  // namespace

std::vector<image::LightOutside> lightsOutside(const Surfaces& surfaces, const Visibility& visibility,
                                               const Illumination& light, float nearest_m) {
  Outside outside(surfaces, visibility, nearest_m);
  const sky::Daylight day = light.day.seenFrom(surfaces.eye);
  outside.add(day.sunSeen());
  outside.add(day.moonSeen());
  if (light.lamps) {
    const Bulbs bulbs(visibility, *light.lamps);
    for (const scene::Lamp& lamp : *light.lamps) outside.add(lamp, bulbs);
  }
  return outside.take();
}

}  // namespace sunlit::light
