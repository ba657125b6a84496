#include "light/bake/gather/lamp_bounces.h"

#include <algorithm>

#include "light/bake/gather/lamps_on_samples.h"
#include "light/lamps/lamp_sets.h"

namespace sunlit::light {
namespace {

/// lx: a hundredth of what a moonless sky gives.
constexpr float kDark_lx = 1e-5f;

BakedLamps::Light stored(const Arrived& arrived) {
  const Eigen::Array3f &above = arrived.above, &below = arrived.below;
  return {above[0], above[1], above[2], below[0], below[1], below[2]};
}

void store(const std::vector<Arrived>& arrived, BakedLamps* baked) {
  constexpr std::size_t kBlock = BakedLamps::kBlock;
  for (std::size_t block = 0; block * kBlock < arrived.size(); ++block) {
    const auto first = arrived.begin() + static_cast<std::ptrdiff_t>(block * kBlock);
    const auto end =
        arrived.begin() + static_cast<std::ptrdiff_t>(std::min(arrived.size(), (block + 1) * kBlock));
    const bool lit = std::any_of(first, end, [](const Arrived& sample) {
      return (sample.above + sample.below).maxCoeff() > kDark_lx;
    });
    if (!lit) continue;
    baked->blocks.push_back(static_cast<std::uint32_t>(block));
    baked->light.resize(baked->blocks.size() * kBlock);
    std::transform(first, end, baked->light.end() - kBlock, stored);
  }
  baked->first.push_back(static_cast<std::uint32_t>(baked->blocks.size()));
}

}  // namespace

BakedLamps bakeLamps(const BakeScene& scene, const SceneSamples& samples, const Exchange& exchange,
                     int bounces) {
  const std::vector<scene::Lamp>& lamps = scene.geometry.scene->lamps;
  BakedLamps baked;
  baked.first.push_back(0);
  for (const LampSet& set : lampSets(lamps)) {
    const std::vector<scene::Lamp> members = lampsOf(set, lamps);
    const std::vector<LampBeam> beams(members.begin(), members.end());
    store(exchange.passedOn(lampsOnSamples(scene, samples, beams), bounces), &baked);
  }
  return baked;
}

void addLamps(const BakedLamps& lamps, std::size_t set, float share, std::vector<BakedLamps::Light>* light) {
  constexpr std::size_t kBlock = BakedLamps::kBlock;
  for (std::size_t k = lamps.first[set]; k < lamps.first[set + 1]; ++k) {
    const std::size_t first = lamps.blocks[k] * kBlock, end = std::min(light->size(), first + kBlock);
    for (std::size_t i = first; i < end; ++i)
      for (std::size_t c = 0; c < 6; ++c) (*light)[i][c] += share * lamps.light[k * kBlock + i - first][c];
  }
}

}  // namespace sunlit::light
