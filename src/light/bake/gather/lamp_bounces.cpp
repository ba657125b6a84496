#include "light/bake/gather/lamp_bounces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "light/bake/gather/lamp_lit.h"
#include "light/bake/gather/lamps_on_samples.h"
#include "light/bake/samples/looked_for.h"
#include "light/bake/samples/mesh_leaves.h"
#include "light/bake/samples/met_sample.h"
#include "light/lamps/lamp_sets.h"
#include "sunlit/quantity/angle.h"

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

void add(const std::vector<Arrived>& more, std::vector<Arrived>* all) {
  for (std::size_t i = 0; i < all->size(); ++i) (*all)[i] += more[i];
}

void storeGlow(const Eigen::Array3f& light, std::size_t sample, PassedOn* part) {
  part->glows[sample] = {light[0], light[1], light[2]};
}

}  // namespace

/// What each sample has of these.
std::vector<Arrived> LampBounces::lookFor(const std::vector<AreaLights::Piece>& pieces,
                                          const Progress& progress) const {
  const AreaLights lights(scene_.rays, pieces);
  std::vector<Arrived> found(samples_.receivers.size());
  if (!lights.any()) return found;
  WorkDone done(progress, found.size());
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    const Receiver& receiver = samples_.receivers[i];
    const AreaLights::Light light = receiver.coarse ? lights.about(receiver, i) : lights.at(receiver, i);
    found[i] = {light.above, light.below};
    done.add();
  });
  return found;
}

/// What samples have of each source by way of surfaces, of which those that are lit are looked for. White
/// walls of a room pass on as much of each other's light as they have straight from lamps: who looks into it
/// through a window or a gap looks for that, too. How much it is rays alone tell well enough, since many
/// surfaces add to it.
std::vector<std::vector<Arrived>> LampBounces::passedOn(std::vector<Source> sources,
                                                        const Progress& progress) const {
  if (bounces_ < 1) return {sources.size(), std::vector<Arrived>(samples_.receivers.size())};
  constexpr double kPassedOn = 0.3;
  const auto partOfEach = [&](std::size_t i, double from, double to) {
    const double each = (to - from) / static_cast<double>(sources.size()),
                 begin = from + each * static_cast<double>(i);
    return partOf(progress, begin, begin + each);
  };
  std::vector<Exchange::FirstBounce> first;
  for (std::size_t i = 0; i < sources.size(); ++i)
    first.push_back(firstBounce(sources[i], partOfEach(i, 0.0, kPassedOn)));
  std::vector<std::vector<Arrived>> has = exchange_.passedOn(std::move(first));
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Source& source = sources[i];
    if (!looksAgain(source)) continue;
    addBounced(has[i], &source.lit);
    has[i] = exchange_.receivedOf(exchange_.sentOf(source.lamps, has[i]),
                                  lookFor(source.lit, partOfEach(i, kPassedOn, 1.0)));
  }
  return has;
}

std::vector<Arrived> LampBounces::passedOn(Source source, const Progress& progress) const {
  std::vector<Source> one;
  one.push_back(std::move(source));
  return passedOn(std::move(one), progress).front();
}

/// Where samples look again, by rays alone.
Exchange::FirstBounce LampBounces::firstBounce(const Source& source, const Progress& progress) const {
  const std::vector<Arrived> nothing(samples_.receivers.size());
  if (!looksAgain(source)) {
    const Exchange::LookedFor sent = exchange_.sentOf(source.lamps, nothing);
    return {exchange_.receivedOf(sent, lookFor(source.lit, progress)), bounces_};
  }
  StraightLight met = source.lamps;
  std::fill(met.looked_for.begin(), met.looked_for.end(), Eigen::Array3f::Zero());
  return {exchange_.receivedOf(exchange_.sentOf(met, nothing), nothing), bounces_ - 1};
}

/// Adds what surfaces pass on of what they have besides.
void LampBounces::addBounced(const std::vector<Arrived>& has, std::vector<AreaLights::Piece>* lit) const {
  for (AreaLights::Piece& piece : *lit) {
    const std::uint32_t root = samples_.mesh.roots[piece.triangle][piece.side];
    if (!LightMesh::isCell(root)) continue;
    const std::uint32_t sample = exchange_.usefulBeside(sampleOn(samples_, root, piece.within));
    const Sending& sends = exchange_.sendings()[sample];
    Eigen::Array3f light = sends.bounced * has[sample].all();
    if (sends.other != LightMesh::kNone) light += sends.through * has[sends.other].all();
    piece.luminance += piece.looked / kPiFloat * light;
  }
}

BakedLamps LampBounces::bake(const Progress& progress) const {
  const std::vector<scene::Lamp>& lamps = scene_.geometry.scene->lamps;
  BakedLamps baked;
  baked.first.push_back(0);
  const std::vector<LampSet> sets = lampSets(lamps);
  const auto count = static_cast<double>(sets.size());
  for (std::size_t begin = 0, end; begin < sets.size(); begin = end) {
    end = std::min(sets.size(), begin + Exchange::kTogether);
    std::vector<Source> sources;
    for (std::size_t i = begin; i < end; ++i) {
      const std::vector<scene::Lamp> members = lampsOf(sets[i], lamps);
      const std::vector<LampBeam> beams(members.begin(), members.end());
      sources.push_back({lampsOnSamples(scene_, samples_, beams), litPieces(scene_, beams)});
    }
    const Progress part =
        partOf(progress, static_cast<double>(begin) / count, static_cast<double>(end) / count);
    for (const std::vector<Arrived>& arrived : passedOn(std::move(sources), part)) store(arrived, &baked);
  }
  return baked;
}

/// Of each sample, whether all surfaces that have its light may be looked for.
std::vector<bool> LampBounces::sending(const LookedFor& looked) const {
  std::vector<bool> sending(samples_.receivers.size(), true);
  for (std::uint32_t t = 0; t < samples_.mesh.roots.size(); ++t) {
    if (looked.may(scene_, t)) continue;
    for (const std::uint32_t root : samples_.mesh.roots[t]) {
      if (!LightMesh::isCell(root)) continue;
      visitLeaves(samples_.mesh, root, Eigen::Matrix3f::Identity(),
                  [&](const LightMesh::Cell& cell, const Eigen::Matrix3f&) {
                    for (const std::uint32_t node : cell.corner)
                      sending[samples_.nearest_sample[node]] = false;
                  });
    }
  }
  return sending;
}

StraightLight LampBounces::straight(const AreaLights& shining, const LookedFor& looked,
                                    const Progress& progress, std::vector<Arrived>* arrived) const {
  const std::size_t count = samples_.receivers.size();
  const std::vector<bool> sends = sending(looked);
  StraightLight lit(count);
  WorkDone done(progress, count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const AreaLights::Light light = shining.at(samples_.receivers[i], i);
    if (arrived) (*arrived)[i] = {light.above, light.below};
    lit.direct[i] = light.above + light.below;
    lit.lamp_m[i] = light.distance_m;
    if (sends[i]) lit.looked_for[i] = lookedFor(light.distance_m, looked.farthest_m) * lit.direct[i];
    done.add();
  });
  return lit;
}

void LampBounces::bakeShining(const ShiningLights& shining, const Progress& progress,
                              TransportData* data) const {
  std::vector<Arrived> all(samples_.receivers.size());
  if (shining.baked.any()) {
    StraightLight lit =
        straight(shining.baked, {maySendShine, kFarthestByShining_m}, partOf(progress, 0.0, 0.25), &all);
    const Progress part = partOf(progress, 0.25, 0.5);
    add(passedOn({std::move(lit), litPieces(scene_, shining.baked)}, part), &all);
  }
  if (shining.compact.any()) {
    StraightLight lit =
        straight(shining.compact, {maySendLampLight, kFarthestLit_m}, partOf(progress, 0.5, 0.75), nullptr);
    const Progress part = partOf(progress, 0.75, 1.0);
    add(passedOn({std::move(lit), litPieces(scene_, shining.beams)}, part), &all);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    storeGlow(all[i].above, i, &data->above);
    storeGlow(all[i].below, i, &data->below);
  }
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
