// Which points of a grove's leaves light from 175 directions reaches, on one core: by meeting every triangle
// with the points, as the bake does (there half of the directions each), and by a ray from each point, the
// points of a direction together.
#include "light/bake/samples/crown_shadows.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "light/bake/samples/triangle_kinds.h"
#include "light/patches/sky_patches.h"
#include "sunlit/light/world.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace {

using namespace sunlit;

constexpr float kSquare_m = 16.0f, kStep_m = 0.4f, kLargest_m2 = 12.0f;

/// The square of the built-in world that has most leaves.
struct Grove {
  light::World world{
      std::make_shared<const scene::Scene>(scene::load(scene::kRaceTrack, scene::SearchPath{}))};
  light::Cutouts cutouts{*world.geometry};
  std::vector<light::CrownShadows::Point> points;
  std::vector<light::SkyPatches::Ray> directions;

  Grove() {
    std::map<std::pair<int, int>, std::vector<std::uint32_t>> squares;
    const light::Geometry& geometry = *world.geometry;
    for (std::uint32_t t : cutouts.maskedTriangles()) {
      const light::TriangleKind kind = light::triangleKind(geometry, t);
      const Eigen::Vector3f& corner = geometry.positions[geometry.triangles[t][0]];
      if (kind != light::TriangleKind::kSpray && kind != light::TriangleKind::kCanopy) continue;
      if (area(t) > kLargest_m2) continue;  // made to be seen from afar
      squares[{static_cast<int>(std::floor(corner.x() / kSquare_m)),
               static_cast<int>(std::floor(corner.y() / kSquare_m))}]
          .push_back(t);
    }
    const std::vector<std::uint32_t>* most = &squares.begin()->second;
    for (const auto& [place, triangles] : squares) {
      if (triangles.size() > most->size()) most = &triangles;
    }
    for (const std::uint32_t t : *most) addPoints(t);
    const light::SkyPatches patches(1);
    for (const light::SkyPatches::Ray& ray : patches.coarseRays()) {
      if (ray.patch != light::SkyPatches::kBelow) directions.push_back(ray);
    }
  }

  float area(std::uint32_t t) const {
    const auto& c = world.geometry->triangles[t];
    const auto& at = world.geometry->positions;
    return 0.5f * (at[c[1]] - at[c[0]]).cross(at[c[2]] - at[c[0]]).norm();
  }

  void addPoints(std::uint32_t t) {
    const auto& c = world.geometry->triangles[t];
    const auto& at = world.geometry->positions;
    const int steps = static_cast<int>(std::ceil(std::sqrt(2.0f * area(t)) / kStep_m));
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const float u = static_cast<float>(i) / static_cast<float>(steps);
        const float v = static_cast<float>(j) / static_cast<float>(steps);
        points.push_back(
            {(1.0f - u - v) * at[c[0]] + u * at[c[1]] + v * at[c[2]], world.geometry->planes[t].normal});
      }
    }
  }
};

const Grove& grove() {
  static const Grove made;
  return made;
}

void countPairs(benchmark::State& state, std::size_t open) {
  const double pairs = static_cast<double>(grove().points.size() * grove().directions.size());
  state.counters["points"] = static_cast<double>(grove().points.size());
  state.counters["open"] = static_cast<double>(open) / pairs;
  state.counters["pairs_per_second"] =
      benchmark::Counter(pairs, benchmark::Counter::kIsIterationInvariantRate);
}

void meetTriangles(benchmark::State& state) {
  const Grove& g = grove();
  std::size_t open = 0;
  for (auto _ : state) {
    open = 0;
    light::CrownShadows crown({*g.world.geometry, g.cutouts, *g.world.visibility}, g.points, 1.0f);
    for (const light::SkyPatches::Ray& ray : g.directions) {
      for (const std::uint8_t one : crown.open(ray.towards)) open += one;
    }
  }
  countPairs(state, open);
}

void castRays(benchmark::State& state) {
  const Grove& g = grove();
  const std::size_t count = g.points.size();
  std::vector<float> o[3], d[3];
  std::vector<std::uint8_t> blocked(count);
  std::size_t open = 0;
  for (auto _ : state) {
    open = 0;
    for (const light::SkyPatches::Ray& ray : g.directions) {
      for (int axis = 0; axis < 3; ++axis) {
        o[axis].resize(count);
        d[axis].assign(count, ray.towards[axis]);
        for (std::size_t i = 0; i < count; ++i) {
          const float side = g.points[i].normal.dot(ray.towards) > 0.0f ? 1e-3f : -1e-3f;
          o[axis][i] = g.points[i].position[axis] + side * g.points[i].normal[axis];
        }
      }
      g.world.visibility->occluded(
          {o[0].data(), o[1].data(), o[2].data(), d[0].data(), d[1].data(), d[2].data(), count},
          blocked.data());
      for (const std::uint8_t one : blocked) open += one == 0 ? 1 : 0;
    }
  }
  countPairs(state, open);
}

BENCHMARK(meetTriangles)->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK(castRays)->Unit(benchmark::kMillisecond)->Iterations(3);

}  // namespace

BENCHMARK_MAIN();
