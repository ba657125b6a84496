#include "light/bake/samples/sample_order.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "light/geometry/morton.h"

namespace sunlit::light {
namespace {

/// By the samples that have most weight in them.
void orderNodes(LightMesh* mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keys;  // sample, node
  for (std::uint32_t n = 0; n < mesh->nodeCount(); ++n)
    keys.emplace_back(mesh->shares[mesh->first_share[n]].sample, n);
  std::sort(keys.begin(), keys.end());
  image::KeptArray<std::uint32_t> first_share;
  image::KeptArray<LightMesh::Share> shares;
  std::vector<std::uint32_t> moved_to(keys.size());
  for (std::uint32_t number = 0; number < keys.size(); ++number) {
    const std::uint32_t n = keys[number].second;
    moved_to[n] = number;
    first_share.push_back(static_cast<std::uint32_t>(shares.size()));
    for (std::uint32_t s = mesh->first_share[n]; s < mesh->first_share[n + 1]; ++s)
      shares.push_back(mesh->shares[s]);
  }
  first_share.push_back(static_cast<std::uint32_t>(shares.size()));
  mesh->first_share = std::move(first_share);
  mesh->shares = std::move(shares);
  for (LightMesh::Cell& cell : mesh->cells) {
    if (cell.inner()) continue;
    for (std::uint32_t& corner : cell.corner) corner = moved_to[corner];
  }
}

}  // namespace

void orderSamples(SceneSamples* samples) {
  struct Key {
    std::uint64_t block, place;
    bool coarse;
    int facing;
    std::uint32_t sample;
  };
  std::vector<Key> keys;
  for (std::uint32_t i = 0; i < samples->receivers.size(); ++i) {
    const Receiver& receiver = samples->receivers[i];
    int axis = 0;
    receiver.normal.cwiseAbs().maxCoeff(&axis);
    keys.push_back({mortonCode(receiver.origins[0], 32.0f), mortonCode(receiver.origins[0], 0.125f),
                    receiver.coarse, 2 * axis + (receiver.normal[axis] > 0.0f ? 1 : 0), i});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.block, a.coarse, a.facing, a.place, a.sample) <
           std::tie(b.block, b.coarse, b.facing, b.place, b.sample);
  });
  std::vector<Receiver> receivers;
  std::vector<OtherSide> other_side;
  std::vector<std::uint32_t> moved_to(keys.size());
  for (const Key& key : keys) {
    moved_to[key.sample] = static_cast<std::uint32_t>(receivers.size());
    receivers.push_back(samples->receivers[key.sample]);
    other_side.push_back(samples->other_side[key.sample]);
  }
  for (OtherSide& other : other_side) {
    if (other.sample != LightMesh::kNone) other.sample = moved_to[other.sample];
  }
  samples->other_side = std::move(other_side);
  samples->receivers = std::move(receivers);
  for (LightMesh::Share& share : samples->mesh.shares) share.sample = moved_to[share.sample];
  orderNodes(&samples->mesh);
}

}  // namespace sunlit::light
