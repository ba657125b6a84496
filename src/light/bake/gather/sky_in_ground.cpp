#include "light/bake/gather/sky_in_ground.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "light/bake/gather/ground_mirror.h"
#include "sunlit/quantity/photometry.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kPatchCount = SkyPatches::kCount;

/// Adds a row of coefficients, each times `factor` and one of `shares`.
SUNLIT_WIDE_VECTOR_CLONES
void addShares(float factor, const float* shares, const std::uint8_t* coefficients, float* row) {
  for (std::size_t p = 0; p < kPatchCount; ++p)
    row[p] += factor * shares[p] * static_cast<float>(coefficients[p]);
}

}  // namespace

struct SkyInGround::InGround {
  std::array<float, kPatchCount> row{};         ///< luminance
  Eigen::Array3f sum = Eigen::Array3f::Zero();  ///< of its colours
};

/// In ground samples that are wanted(number).
template <typename Wanted>
SkyInGround::InGround SkyInGround::seenBy(const TransportData& data, std::size_t sample,
                                          const Wanted& wanted) const {
  InGround in_ground;
  const SampleHits& seen = exchange_.seen[sample];
  for (std::size_t k = seen.up; k < seen.hits.size(); ++k) {
    const RaySeen ray = exchange_.ray(sample, k);
    if (exchange_.isGround(ray.from) && wanted(ray.from)) add(data, ray, &in_ground);
  }
  if (data.direct_tints.empty())
    in_ground.sum.setConstant(std::accumulate(in_ground.row.begin(), in_ground.row.end(), 0.0f));
  return in_ground;
}

void SkyInGround::add(const TransportData& data, const RaySeen& ray, InGround* in_ground) const {
  const GroundMirror::Row& shares =
      GroundMirror::get().towards(ray.direction, samples_.paints[ray.from].roughness);
  const float factor = ray.weight * data.direct.scales[ray.from];
  if (data.direct_tints.empty())
    return addShares(factor, shares.data(), data.direct.row(ray.from), in_ground->row.data());
  const Eigen::Array3f color = ray.tint.times(data.direct_tints[ray.from].value());
  std::array<float, kPatchCount> row{};
  addShares(factor, shares.data(), data.direct.row(ray.from), row.data());
  const float luminance = LinearRgb(color).luminance();
  for (std::size_t p = 0; p < kPatchCount; ++p) in_ground->row[p] += luminance * row[p];
  in_ground->sum += std::accumulate(row.begin(), row.end(), 0.0f) * color;
}

SkyInGround::OfSamples SkyInGround::find(const TransportData& data) const {
  const std::size_t count = data.sampleCount();
  OfSamples result;
  result.coefficients.resize(count);
  result.sums.resize(count);
  tbb::parallel_for(std::size_t{0}, (count + kSamplesOfTask - 1) / kSamplesOfTask, [&](std::size_t block) {
    for (std::size_t i = block * kSamplesOfTask; i < std::min(count, (block + 1) * kSamplesOfTask); ++i) {
      const InGround in_ground = seenBy(data, i, Exchange::all);
      result.coefficients.set(i, in_ground.row.data());
      result.sums[i] = in_ground.sum;
    }
  });
  return result;
}

/// Sun and moon in polished floors are looked for by rays, sky by sky.
void SkyInGround::tellRooms(const OfSamples& of_samples, TransportData* data) const {
  BakedRooms& rooms = data->rooms;
  const std::size_t count = rooms.samples.size();
  rooms.mirrored.resize(count);
  for (std::size_t room = 0; room < count; ++room)
    rooms.mirrored.copy(of_samples.coefficients, rooms.samples[room], room);
  if (!data->direct_tints.empty()) {
    rooms.mirrored_tints.resize(count);
    for (std::size_t room = 0; room < count; ++room)
      rooms.mirrored_tints[room] = PackedTint(of_samples.sums[rooms.samples[room]]);
  }
  tbb::parallel_for(std::size_t{0}, rooms.glossy.size(), [&](std::size_t g) {
    const std::uint32_t room = rooms.glossy[g].room;
    const auto rough = [this](std::uint32_t ground) { return !exchange_.isPolished(ground); };
    rooms.mirrored.set(room, seenBy(*data, rooms.samples[room], rough).row.data());
  });
}

}  // namespace sunlit::light
