#include "light/bake/samples/light_mesh.h"

#include <tuple>

namespace sunlit::light {

LightMesh::Place LightMesh::locate(std::uint32_t root, std::array<float, 3> barycentric) const {
  // In registers: an array that is asked for by `edge` is waited for at each step, as it was just stored.
  auto [from, to, apex] = barycentric;
  const Cell* cell = &cells[root];
  while (cell->inner()) {
    if (cell->edge() == 1) {
      std::tie(from, to, apex) = std::make_tuple(to, apex, from);
    } else if (cell->edge() == 2) {
      std::tie(from, to, apex) = std::make_tuple(apex, from, to);
    }
    // The children are (from, point, apex) and (point, to, apex).
    bool first;
    if (cell->halved()) {  // most are: the same bits as below, in a fraction of the time
      first = from >= to;
      std::tie(from, to) =
          first ? std::make_tuple(from - to, to + to) : std::make_tuple(from + from, to - from);
    } else {
      const float before = cell->share(), after = 1.0f - before;
      first = from * before >= to * after;
      std::tie(from, to) = first ? std::make_tuple(from - to * (after / before), to / before)
                                 : std::make_tuple(from / after, to - from * (before / after));
    }
    cell = &cells[cell->child() + (first ? 0u : 1u)];
  }
  return {cell->corner, {from, to, apex}};
}

std::vector<std::uint32_t> LightMesh::usefulSamples(const std::vector<bool>& useless,
                                                    const Parted& parted) const {
  std::vector<std::uint32_t> samples(nodeCount(), kNone), own(nodeCount(), kNone);
  for (std::size_t n = 0; n < nodeCount(); ++n) {
    float most = 0.0f, most_own = 0.0f;
    for (std::uint32_t s = first_share[n]; s < first_share[n + 1]; ++s) {
      const Share& share = shares[s];
      if (share.weight > most_own) most_own = share.weight, own[n] = share.sample;
      if (useless[share.sample] || share.weight <= most) continue;
      most = share.weight;
      samples[n] = share.sample;
    }
  }
  const auto spread = [&](bool anywhere) {
    constexpr int kRings = 4;  // as many as SceneSamples are filled over
    std::vector<std::uint32_t> found = samples;
    for (int ring = 0; ring < kRings; ++ring) {
      const std::vector<std::uint32_t> before = found;
      for (const Cell& cell : cells) {
        if (cell.inner()) continue;
        for (const std::uint32_t n : cell.corner) {
          for (const std::uint32_t from : cell.corner) {
            if (found[n] == kNone && before[from] != kNone && (anywhere || !parted(own[n], before[from])))
              found[n] = before[from];
          }
        }
      }
    }
    return found;
  };
  const std::vector<std::uint32_t> anyhow = spread(true);
  samples = spread(false);
  for (std::size_t n = 0; n < nodeCount(); ++n)
    if (samples[n] == kNone) samples[n] = anyhow[n];
  return samples;
}

void LightMesh::drop(const std::vector<bool>& useless, const std::vector<std::uint32_t>& useful) {
  for (std::size_t n = 0; n < nodeCount(); ++n) {
    if (useful[n] == kNone) continue;
    float sum = 0.0f;
    for (std::uint32_t s = first_share[n]; s < first_share[n + 1]; ++s)
      sum += useless[shares[s].sample] ? 0.0f : shares[s].weight;
    for (std::uint32_t s = first_share[n]; s < first_share[n + 1]; ++s)
      shares[s].weight *= useless[shares[s].sample] ? 0.0f : 1.0f / sum;
    if (sum <= 0.0f) shares[first_share[n]] = {useful[n], 1.0f};
  }
}

}  // namespace sunlit::light
