/// The sky by way of the ground as a mirror, as samples see it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "light/bake/gather/exchange.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// Once `data` knows the direct light of all samples and what each of them sees. Keeps references.
class SkyInGround {
 public:
  SkyInGround(const SceneSamples& samples, const Exchange& exchange)
      : samples_(samples), exchange_(exchange) {}

  /// Of each sample: luminance by patches, and the sums over these with their colours, lx. Parallel; the same
  /// bits for any number of threads.
  struct OfSamples {
    Coefficients coefficients;
    std::vector<Eigen::Array3f> sums;
  };
  OfSamples find(const TransportData& data) const;
  /// Sets BakedRooms::mirrored and its tints, by what all samples see.
  void tellRooms(const OfSamples& of_samples, TransportData* data) const;

 private:
  struct InGround;
  template <typename Wanted>
  InGround seenBy(const TransportData& data, std::size_t sample, const Wanted& wanted) const;
  void add(const TransportData& data, const RaySeen& ray, InGround* in_ground) const;

  const SceneSamples& samples_;
  const Exchange& exchange_;
};

}  // namespace sunlit::light
