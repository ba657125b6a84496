#include "light/bake/samples/adaptive_probe.h"

namespace sunlit::light {

AdaptiveProbe::AdaptiveProbe(const BakeRays& scene, const std::vector<TriangleTraits>& traits,
                             const SkyPatches& patches)
    : scene_(scene), traits_(traits), rays_(patches.rays()), parts_(SkyPatches::kCoarse) {
  for (std::size_t first = 0, end = 0; first < rays_.size(); first = end) {
    const int patch = rays_[first].patch;
    const bool above = patch != SkyPatches::kBelow;
    end = first + 1;
    while (above && end < rays_.size() && rays_[end].patch == patch) ++end;
    std::size_t coarse = first;
    while (rays_[coarse].coarse == SkyPatches::Ray::kFineOnly) ++coarse;
    Part& part = parts_[static_cast<std::size_t>(rays_[coarse].coarse)];
    part = {first, coarse, end, {}, above && SkyPatches::ringOf(patch) == 0};
    if (above) part.beside = SkyPatches::neighbours(patch);
  }
}

void AdaptiveProbe::look(const ReceiverGroup& receivers, const Visit& visit) const {
  AllCoarseHits all;
  castCoarse(receivers, &all);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    // Where the coarse ray goes below the receiver's horizon, the others may not.
    const Lanes fine = (mixed(all, p) | ~all[p].cast) & ~receivers.coarse();
    castOthers(receivers, p, fine, visit);
    if (all[p].cast == 0) continue;
    const Weights weights = this->weights(receivers, parts_[p], fine);
    for (int i = 0; i < receivers.count(); ++i) {
      if (ReceiverGroup::has(all[p].cast, i))
        visit(i, parts_[p].coarse, weights[static_cast<std::size_t>(i)], all[p].hits);
    }
  }
}

void AdaptiveProbe::castCoarse(const ReceiverGroup& receivers, AllCoarseHits* all) const {
  Weights weights;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    CoarseHits& met = (*all)[p];
    const std::size_t ray = parts_[p].coarse;
    met.cast = receivers.weigh(rays_[ray].towards, weights.data());
    met.open = met.leaf = met.dim = 0;
    if (met.cast == 0) continue;
    receivers.cast(scene_, {turn(p, ray), rays_[ray].towards, met.cast}, &met.hits);
    for (int i = 0; i < receivers.count(); ++i) {
      const std::uint32_t hit = met.hits.ends.triangle[i];
      if (met.hits.shareOfEnd(i) < 0.5f) met.dim |= Lanes{1} << i;
      if (hit == HitPacket::kNothing) {
        met.open |= Lanes{1} << i;
      } else if (isLeaf(traits_[hit].kind)) {
        met.leaf |= Lanes{1} << i;
      }
    }
  }
}

/// Whose turn it is among a receiver's origins. With an even number of rays a patch, and an even number of
/// origins, every coarse ray would start from the same one.
std::size_t AdaptiveProbe::turn(std::size_t number, std::size_t ray) const {
  const Part& part = parts_[number];
  return (part.end - part.first) % 2 == 0 ? ray + number : ray;
}

/// Sites for which one ray does not tell what the whole part holds.
AdaptiveProbe::Lanes AdaptiveProbe::mixed(const AllCoarseHits& all, std::size_t part) const {
  if (parts_[part].always) return ~Lanes{0};
  const CoarseHits& here = all[part];
  Lanes lanes = here.leaf;
  for (const int other : parts_[part].beside) {
    const CoarseHits& there = all[static_cast<std::size_t>(other)];
    lanes |= here.cast & there.cast & ((here.open ^ there.open) | (here.dim ^ there.dim));
  }
  return lanes;
}

void AdaptiveProbe::castOthers(const ReceiverGroup& receivers, std::size_t number, Lanes lanes,
                               const Visit& visit) const {
  const Part& part = parts_[number];
  HitLayers hits;
  Weights weights;
  for (std::size_t r = part.first; lanes != 0 && r < part.end; ++r) {
    if (r == part.coarse) continue;
    const Lanes cast = lanes & receivers.weigh(rays_[r].towards, weights.data());
    if (cast == 0) continue;
    receivers.cast(scene_, {turn(number, r), rays_[r].towards, cast}, &hits);
    for (int i = 0; i < receivers.count(); ++i) {
      if (ReceiverGroup::has(cast, i))
        visit(i, r, weights[static_cast<std::size_t>(i)] * rays_[r].solid_angle, hits);
    }
  }
}

/// Of the coarse ray: for `fine` receivers of its share of the part, for others of the whole part.
AdaptiveProbe::Weights AdaptiveProbe::weights(const ReceiverGroup& receivers, const Part& part,
                                              Lanes fine) const {
  const float angle = rays_[part.coarse].solid_angle;
  const auto rays = static_cast<float>(part.end - part.first);
  Weights own, other, sum{};
  receivers.weigh(rays_[part.coarse].towards, own.data());
  for (std::size_t r = part.first; r < part.end; ++r) {
    receivers.weigh(rays_[r].towards, other.data());
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += other[i] * angle;
  }
  for (int i = 0; i < receivers.count(); ++i) {
    const auto receiver = static_cast<std::size_t>(i);
    if (ReceiverGroup::has(fine, i)) sum[receiver] = own[receiver] * angle;
    // Such may take light from both sides: only the direction that is looked in counts.
    if (ReceiverGroup::has(receivers.coarse(), i)) sum[receiver] = own[receiver] * angle * rays;
  }
  return sum;
}

}  // namespace sunlit::light
