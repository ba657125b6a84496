#include "light/transport/relight.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "light/transport/patch_sky.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kPatches = SkyPatches::kCount;

/// A disc as additional luminance of the patches around it.
struct SmallLight {
  std::array<PatchShare, 4> shares;
  std::array<Eigen::Array3f, 4> luminances;

  explicit SmallLight(const sky::DiscLight& disc) {
    shares = SkyPatches::around(disc.towards.vector().cast<float>());
    for (std::size_t k = 0; k < 4; ++k)
      luminances[k] = disc.illuminance.value * (shares[k].share / SkyPatches::solidAngle(shares[k].patch));
  }
  Eigen::Array3f times(const std::uint8_t* row) const {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (std::size_t k = 0; k < 4; ++k) sum += luminances[k] * static_cast<float>(row[shares[k].patch]);
    return sum;
  }
};

/// The share of an even sphere's light, by cosine, that surfaces hide from a sample.
float hiddenShare(const Coefficients& direct, std::size_t sample) {
  std::uint32_t sum = 0;
  const std::uint8_t* row = direct.row(sample);
  for (std::size_t p = 0; p < kPatches; ++p) sum += row[p];
  return 1.0f - static_cast<float>(sum) * direct.scales[sample] / kPiFloat;
}

NodeLight sampleLight(const TransportData& data, const sky::Daylight& day) {
  const PatchSky sky(SkyPatches::luminances(day, SkyPatches::Weight::kCosine));
  const SmallLight sun(day.sun()), moon(day.moon());
  NodeLight light;
  light.irradiance.resize(data.tints.size());
  light.surroundings.resize(data.tints.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, data.tints.size(), 1024),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        const std::uint8_t* row = data.bounced.row(i);
                        const Eigen::Array3f tint = Eigen::Map<const Eigen::Array3f>(data.tints[i].data());
                        const Eigen::Array3f bounced = (sky.times(row) + sun.times(row) + moon.times(row)) *
                                                           (data.bounced.scales[i] * tint) +
                                                       Eigen::Map<const Eigen::Array3f>(data.glows[i].data());
                        light.irradiance[i] = sky.times(data.direct.row(i)) * data.direct.scales[i] + bounced;
                        // Where next to nothing is hidden, rounding must not make it shine.
                        const float hidden = std::max(hiddenShare(data.direct, i), 0.02f);
                        light.surroundings[i] = bounced / (kPiFloat * hidden);
                      }
                    });
  return light;
}

}  // namespace

NodeLight relight(const TransportData& data, const sky::Daylight& day) {
  const NodeLight samples = sampleLight(data, day);
  const LightMesh& mesh = data.mesh;
  NodeLight nodes;
  nodes.irradiance.resize(mesh.nodeCount());
  nodes.surroundings.resize(mesh.nodeCount());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.nodeCount(), 4096),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t n = range.begin(); n != range.end(); ++n) {
                        Eigen::Array3f irradiance = Eigen::Array3f::Zero(), around = Eigen::Array3f::Zero();
                        for (std::uint32_t s = mesh.first_share[n]; s < mesh.first_share[n + 1]; ++s) {
                          const LightMesh::Share& share = mesh.shares[s];
                          irradiance += samples.irradiance[share.sample] * share.weight;
                          around += samples.surroundings[share.sample] * share.weight;
                        }
                        nodes.irradiance[n] = irradiance;
                        nodes.surroundings[n] = around;
                      }
                    });
  return nodes;
}

}  // namespace sunlit::light
