/// Positions of sun and moon per second on one core. items_per_second is the number to read; the ratios
/// between the lines of one run say what the split into time-only and per-place terms is worth.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "sunlit/astronomy/celestial.h"
#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/moon_position.h"
#include "sunlit/astronomy/star_catalogue.h"
#include "sunlit/astronomy/sun_position.h"
#include "sunlit/astronomy/sun_times.h"

namespace {

using namespace sunlit;
using namespace sunlit::astronomy;

const Instant kStart = instantOf({2024, 7, 1, 12, 0, 0.0, 3.0});
const EarthRotation kEarth{0.0, 69.184};
const Site kTrack{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};
constexpr Air kAir;
constexpr double kStep_s = 60.0;

std::vector<Site> randomSites(std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> latitude(-90.0, 90.0), longitude(-180.0, 180.0);
  std::vector<Site> sites;
  for (std::size_t i = 0; i < count; ++i) {
    sites.push_back({Angle::degrees(latitude(random)), Angle::degrees(longitude(random)), 0.0});
  }
  return sites;
}

/// A new instant each time, one place.
void singlePositions(benchmark::State& state) {
  Instant instant = kStart;
  for (auto _ : state) {
    instant = instant.plusSeconds(kStep_s);
    benchmark::DoNotOptimize(sunPosition(instant, kEarth, kTrack, kAir));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(singlePositions);

/// Many instants, one place, by the batch function.
void batchOfInstants(benchmark::State& state) {
  std::vector<Instant> instants;
  for (std::int64_t i = 0; i < state.range(0); ++i)
    instants.push_back(kStart.plusSeconds(static_cast<double>(i) * kStep_s));
  for (auto _ : state) benchmark::DoNotOptimize(sunPositions(instants, kEarth, kTrack, kAir));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(batchOfInstants)->Arg(1000);

/// Many places, one instant, by the batch function: time-only terms once.
void batchOfPlaces(benchmark::State& state) {
  const std::vector<Site> sites = randomSites(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(sunPositions(solarCoordinates(kStart, kEarth), sites, kAir));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(batchOfPlaces)->Arg(1000);

/// The same one by one, as a caller would who does not know of solarCoordinates().
void placesOneByOne(benchmark::State& state) {
  const std::vector<Site> sites = randomSites(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    for (const Site& site : sites) benchmark::DoNotOptimize(sunPosition(kStart, kEarth, site, kAir));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(placesOneByOne)->Arg(1000);

void timeOnlyTerms(benchmark::State& state) {
  Instant instant = kStart;
  for (auto _ : state) {
    instant = instant.plusSeconds(kStep_s);
    benchmark::DoNotOptimize(solarCoordinates(instant, kEarth));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(timeOnlyTerms);

/// A new instant each time, one place, the sun known already: what the moon adds to a sun.
void singleMoons(benchmark::State& state) {
  Instant instant = kStart;
  const SolarCoordinates sun = solarCoordinates(kStart, kEarth);
  for (auto _ : state) {
    instant = instant.plusSeconds(kStep_s);
    benchmark::DoNotOptimize(moonPosition(lunarCoordinates(instant, kEarth), sun, kTrack, kAir));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(singleMoons);

/// What the stars add.
void celestialAxes(benchmark::State& state) {
  Instant instant = kStart;
  for (auto _ : state) {
    instant = instant.plusSeconds(kStep_s);
    benchmark::DoNotOptimize(mapFromCelestial(instant, kEarth, kTrack));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(celestialAxes);

/// At the start of a renderer. Fast where the files are not installed.
void starCatalogue(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(readStarCatalogue());
}
BENCHMARK(starCatalogue)->Unit(benchmark::kMillisecond);

void sunTimesOfADay(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(sunTimes({2024, 7, 1, 3.0}, kTrack, kAir, kEarth));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(sunTimesOfADay)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
