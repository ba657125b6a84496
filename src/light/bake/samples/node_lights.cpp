#include "light/bake/samples/node_lights.h"

#include <array>
#include <thread>

namespace sunlit::light {

void NodeLights::find(std::size_t block) const {
  std::uint8_t state = kUnknown;
  if (!states_[block].compare_exchange_strong(state, kBeingFound, std::memory_order_acquire)) {
    // It takes another thread some microseconds.
    while (states_[block].load(std::memory_order_acquire) != kFound) std::this_thread::yield();
    return;
  }
  const std::size_t first = block * kBlock, end = std::min(first + kBlock, count_);
  std::array<NodeLight, kBlock> light;
  find_(first, end, light.data());
  PackedLight* value = &values_[block * kOfBlock];
  for (std::size_t n = first; n < end; ++n)
    for (const Eigen::Array3f& one :
         {light[n - first].irradiance, light[n - first].around.above, light[n - first].around.below})
      for (Eigen::Index c = 0; c < 3; ++c) *value++ = PackedLight(one[c]);
  *value = PackedLight(0.0f);
  states_[block].store(kFound, std::memory_order_release);
}

}  // namespace sunlit::light
