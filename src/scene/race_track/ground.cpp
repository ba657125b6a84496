#include "scene/race_track/ground.h"

#include <algorithm>
#include <cmath>

namespace sunlit::scene::race_track {
namespace {

// Middle of the track, about which the hills stand.
const Eigen::Vector2d kMiddle(-10.0, 90.0);

// Long swells that the road follows.
double swell(const Eigen::Vector2d& p) {
  const float x = static_cast<float>(p.x());
  const float y = static_cast<float>(p.y());
  return 2.6 * noise(x / 170.0f + 0.31f, y / 170.0f + 0.17f, 11u) + 0.9 * noise(x / 85.0f, y / 85.0f, 12u);
}

// Height of the hills over azimuth: low where the summer sun rises and sets, so that it reaches the track.
double skyline(const Eigen::Vector2d& direction) {
  const double azimuth = std::atan2(direction.x(), direction.y());
  const auto gap = [&](double at, double width) {
    const double d = std::remainder(azimuth - at, 2.0 * M_PI) / width;
    return std::exp(-d * d);
  };
  return std::max(0.12, 1.0 - 0.95 * gap(0.95, 0.35) - 0.95 * gap(-0.95, 0.35));
}

double hills(const Eigen::Vector2d& p) {
  const Eigen::Vector2d d = p - kMiddle;
  const double distance = d.norm();
  const float x = static_cast<float>(p.x());
  const float y = static_cast<float>(p.y());
  const double rise = smoothStep(280.0f, 1100.0f, static_cast<float>(distance));
  const double ridges = 0.62 + 0.42 * fractal(x / 420.0f, y / 420.0f, 4, 21u);
  const double rolling =
      4.0 * smoothStep(220.0f, 420.0f, static_cast<float>(distance)) * noise(x / 120.0f, y / 120.0f, 22u);
  return rolling + 125.0 * rise * std::max(0.05, ridges) * skyline(d);
}

// Earth banks behind the barriers, here and there, but not at the start, where distances along the track
// begin anew and a bank would break off.
double bank(const TrackPlace& place) {
  const double length = course().length();
  const float s = static_cast<float>(place.along - length * std::floor(place.along / length));
  const double side = std::abs(place.left);
  const float from_start = std::min(s, static_cast<float>(length) - s);
  const double presence = smoothStep(0.15f, 0.5f, noise(s / 70.0f, place.left > 0 ? 3.0f : 9.0f, 31u)) *
                          smoothStep(0.0f, 30.0f, from_start);
  const float across = static_cast<float>(side);
  return 2.2 * presence * smoothStep(14.0f, 20.0f, across) * (1.0 - smoothStep(21.0f, 27.0f, across));
}

double heightAt(const Eigen::Vector2d& point, const TrackPlace& place) {
  const float side = static_cast<float>(std::abs(place.left));
  const double road = swell(course().point({place.along, 0.0}));
  const float x = static_cast<float>(point.x());
  const float y = static_cast<float>(point.y());
  const double rough =
      0.05 * fractal(x / 1.7f, y / 1.7f, 2, 41u) + 0.16 * fractal(x / 9.0f, y / 9.0f, 2, 42u);
  const double blend = smoothStep(7.0f, 20.0f, side);
  const double bumps = rough * smoothStep(static_cast<float>(kHalfWidth) + 1.4f, 9.0f, side);
  // A shallow ditch beside the asphalt.
  const double ditch = -0.10 * smoothStep(5.8f, 7.0f, side) * (1.0 - smoothStep(8.0f, 10.0f, side));
  const double land = swell(point) + hills(point);
  return road + blend * (land - road) + bumps + ditch + bank(place) - swell(Eigen::Vector2d::Zero());
}

// Grid lines: `fine` apart from low to high, then ever wider to `reach` beyond.
std::vector<double> gridLines(double low, double high, double fine, double reach) {
  std::vector<double> lines;
  for (double x = low; x <= high; x += fine) lines.push_back(x);
  for (double step = fine * 1.3, x = lines.back() + step; x < high + reach; step *= 1.16, x += step)
    lines.push_back(x);
  std::vector<double> before;
  for (double step = fine * 1.3, x = low - step; x > low - reach; step *= 1.16, x -= step)
    before.push_back(x);
  lines.insert(lines.begin(), before.rbegin(), before.rend());
  return lines;
}

struct LandGrid {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Color> colors;
};

LandGrid makeLand() {
  constexpr double kFine_m = 4.6;
  constexpr double kReach_m = 2600.0;
  constexpr float kSunk_m = 0.5f;
  const std::vector<double> xs = gridLines(-260.0, 232.0, kFine_m, kReach_m);
  const std::vector<double> ys = gridLines(-70.0, 262.0, kFine_m, kReach_m);
  LandGrid grid;
  grid.columns = xs.size();
  grid.rows = ys.size();
  for (const double y : ys) {
    for (const double x : xs) {
      const Eigen::Vector2d p(x, y);
      const TrackPlace place = course().nearest(p);
      const double z = heightAt(p, place);
      constexpr double kStep = 0.5;
      const double dx = groundHeight(Eigen::Vector2d(x + kStep, y)) - z;
      const double dy = groundHeight(Eigen::Vector2d(x, y + kStep)) - z;
      grid.normals.push_back(Eigen::Vector3d(-dx, -dy, kStep).normalized().cast<float>());
      grid.points.push_back(Eigen::Vector3d(x, y, z).cast<float>());
      if (std::abs(place.left) < 9.0) grid.points.back().z() -= kSunk_m;
      grid.colors.push_back(turfColor(p));
    }
  }
  return grid;
}

using Span = std::array<std::size_t, 2>;

Mesh landBlock(const LandGrid& grid, const Span& is, const Span& js) {
  Mesh mesh;
  const std::uint32_t width = static_cast<std::uint32_t>(is[1] - is[0] + 1);
  for (std::size_t j = js[0]; j <= js[1]; ++j) {
    for (std::size_t i = is[0]; i <= is[1]; ++i) {
      const std::size_t k = j * grid.columns + i;
      mesh.positions.push_back(grid.points[k]);
      mesh.normals.push_back(grid.normals[k]);
      mesh.colors.push_back(grid.colors[k]);
      if (i == is[1] || j == js[1]) continue;
      const std::uint32_t a = static_cast<std::uint32_t>((j - js[0]) * width + (i - is[0]));
      mesh.triangles.push_back({a, a + 1, a + width + 1});
      mesh.triangles.push_back({a, a + width + 1, a + width});
    }
  }
  return mesh;
}

}  // namespace

double groundHeight(const Eigen::Vector2d& point) {
  return heightAt(point, course().nearest(point));
}

double groundHeight(const TrackPlace& place) {
  return heightAt(course().point(place), place);
}

Eigen::Vector3f groundPoint(const Eigen::Vector2d& point) {
  return Eigen::Vector3d(point.x(), point.y(), groundHeight(point)).cast<float>();
}

Eigen::Vector3f groundPoint(const TrackPlace& place) {
  const Eigen::Vector2d point = course().point(place);
  return Eigen::Vector3d(point.x(), point.y(), heightAt(point, place)).cast<float>();
}

Color turfColor(const Eigen::Vector2d& point) {
  const float x = static_cast<float>(point.x());
  const float y = static_cast<float>(point.y());
  const Color lush(0.062f, 0.105f, 0.026f);
  const Color dry(0.185f, 0.165f, 0.075f);
  const Color soil(0.150f, 0.110f, 0.072f);
  const float dryness = smoothStep(-0.25f, 0.65f, fractal(x / 23.0f, y / 23.0f, 5, 51u));
  const float bare = smoothStep(0.42f, 0.62f, fractal(x / 6.0f, y / 6.0f, 4, 52u));
  Color color = lush + 0.75f * dryness * (dry - lush);
  color *= 1.0f + 0.25f * fractal(x / 60.0f, y / 60.0f, 3, 53u);
  color += 0.8f * bare * (soil - color);
  // Far away lie fields of different crops.
  const float far = smoothStep(260.0f, 380.0f, static_cast<float>((point - kMiddle).norm()));
  if (far > 0.0f) {
    const Cell field = cellular(x / 130.0f, y / 90.0f, 54u);
    const float hue = static_cast<float>(field.id % 997u) / 997.0f;
    const Color crop = hue < 0.35f ? Color(0.20f, 0.17f, 0.07f) : Color(0.05f + 0.05f * hue, 0.10f, 0.03f);
    color += 0.6f * far * (crop * (0.8f + 0.4f * hue) - color);
  }
  return color;
}

void addLand(Assembly& assembly) {
  const LandGrid grid = makeLand();
  constexpr std::size_t kBlock = 16;
  for (std::size_t j = 0; j + 1 < grid.rows; j += kBlock) {
    for (std::size_t i = 0; i + 1 < grid.columns; i += kBlock) {
      Mesh mesh = landBlock(grid, {i, std::min(i + kBlock, grid.columns - 1)},
                            {j, std::min(j + kBlock, grid.rows - 1)});
      mesh.name = "land " + std::to_string(i / kBlock) + " " + std::to_string(j / kBlock);
      mesh.material = assembly.palette().grass;
      assembly.add(std::move(mesh));
    }
  }
}

}  // namespace sunlit::scene::race_track
