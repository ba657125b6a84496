#include "light/bake/samples/light_mesh.h"

namespace sunlit::light {

LightMesh::Place LightMesh::locate(std::uint32_t root, std::array<float, 3> barycentric) const {
  constexpr std::array<std::size_t, 3> kNext{1, 2, 0};
  std::uint32_t at = root;
  while (cells[at].inner()) {
    const std::size_t k = cells[at].corner[1];
    const float from = barycentric[k];
    const float to = barycentric[kNext[k]];
    const float apex = barycentric[kNext[kNext[k]]];
    // The children are (from, point, apex) and (point, to, apex).
    bool first;
    if (cells[at].halved()) {  // most are: the same bits as below, in a fraction of the time
      first = from >= to;
      barycentric = {first ? from - to : from + from, first ? to + to : to - from, apex};
    } else {
      const float before = cells[at].share(), after = 1.0f - before;
      first = from * before >= to * after;
      barycentric = first ? std::array<float, 3>{from - to * (after / before), to / before, apex}
                          : std::array<float, 3>{from / after, to - from * (before / after), apex};
    }
    at = cells[at].child() + (first ? 0u : 1u);
  }
  return {cells[at].corner, barycentric};
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
