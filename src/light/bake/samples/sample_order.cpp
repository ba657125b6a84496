#include "light/bake/samples/sample_order.h"

#include <algorithm>
#include <tuple>

#include "light/geometry/morton.h"

namespace sunlit::light {
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
}

}  // namespace sunlit::light
