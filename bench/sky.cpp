/// What the sky costs: tables at start, a daylight for each change of sun, and look-ups in hot loops.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "sunlit/sky/atmosphere.h"

namespace {

using namespace sunlit;
using namespace sunlit::sky;

const Atmosphere& clearAir() {
  static const Atmosphere atmosphere{AtmosphereOptions{}};
  return atmosphere;
}

SunInSky sunAt(double elevation_deg) {
  return {Direction(Azimuth::degrees(140.0), Angle::degrees(elevation_deg)), 1.0};
}

NightSky starryNight() {
  NightSky night;
  night.moon = MoonInSky{Direction(Azimuth::degrees(60.0), Angle::degrees(30.0)), std::nullopt, 384400e3,
                         Angle::degrees(30.0)};
  night.map_from_celestial = Eigen::Matrix3d::Identity();
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  auto stars = std::make_shared<std::vector<Star>>();
  for (int i = 0; i < 9096; ++i) {  // as many as the Bright Star Catalogue has
    const Eigen::Vector3f v(normal(random), normal(random), normal(random));
    stars->push_back({v.normalized(), starIlluminance(2.0 + 4.5 * (i % 97) / 97.0, 0.5)});
  }
  night.stars = stars;
  return night;
}

void precompute(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(Atmosphere{AtmosphereOptions{}});
  }
}
BENCHMARK(precompute)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

void daylight(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(clearAir().daylight(sunAt(static_cast<double>(state.range(0)))));
  }
}
BENCHMARK(daylight)
    ->Arg(40)
    ->Arg(-6)
    ->Arg(-30)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void daylightWithMoonAndStars(benchmark::State& state) {
  const NightSky night = starryNight();
  for (auto _ : state) {
    benchmark::DoNotOptimize(clearAir().daylight(sunAt(static_cast<double>(state.range(0))), night));
  }
}
BENCHMARK(daylightWithMoonAndStars)
    ->Arg(40)
    ->Arg(-6)
    ->Arg(-30)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

/// Pixels of a camera that looks over the horizon, row by row.
std::vector<Eigen::Vector3f> directions() {
  constexpr int kSide = 128;
  std::vector<Eigen::Vector3f> result;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const Eigen::Vector3f pixel(1.0F, 0.6F - 1.2F * static_cast<float>(column) / kSide,
                                  0.4F - 0.8F * static_cast<float>(row) / kSide);
      result.push_back(pixel.normalized());
    }
  }
  return result;
}

void skyLuminance(benchmark::State& state) {
  const Daylight day = clearAir().daylight(sunAt(static_cast<double>(state.range(0))), starryNight());
  const std::vector<Eigen::Vector3f> towards = directions();
  for (auto _ : state) {
    for (const Eigen::Vector3f& v : towards) {
      benchmark::DoNotOptimize(day.skyLuminance(v));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(towards.size()));
}
BENCHMARK(skyLuminance)->Arg(40)->Arg(-30);

Daylight underBrokenCloud() {
  Weather weather;
  weather.cover_oktas = 4.0;
  return clearAir().daylight(sunAt(40.0), {}, weather);
}

void skyLuminanceBroken(benchmark::State& state) {
  const Daylight day = underBrokenCloud();
  const std::vector<Eigen::Vector3f> towards = directions();
  for (auto _ : state) {
    for (const Eigen::Vector3f& v : towards) {
      benchmark::DoNotOptimize(day.skyLuminance(v));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(towards.size()));
}
BENCHMARK(skyLuminanceBroken);

void throughCloud(benchmark::State& state) {
  const Daylight day = underBrokenCloud();
  const std::vector<Eigen::Vector3f> places = directions();
  for (auto _ : state) {
    for (const Eigen::Vector3f& place : places) {
      benchmark::DoNotOptimize(day.throughCloud(day.sun(), 100.0F * place));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(places.size()));
}
BENCHMARK(throughCloud);

void airOver(benchmark::State& state) {
  const Daylight day = clearAir().daylight(sunAt(static_cast<double>(state.range(0))), starryNight());
  const std::vector<Eigen::Vector3f> towards = directions();
  for (auto _ : state) {
    float distance_m = 5.0F;
    for (const Eigen::Vector3f& v : towards) {
      benchmark::DoNotOptimize(day.airOver(v, distance_m));
      distance_m += 0.1F;
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(towards.size()));
}
BENCHMARK(airOver)->Arg(40)->Arg(-30);

}  // namespace

int main(int argc, char** argv) {
  clearAir();  // not part of the first line that needs it
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
