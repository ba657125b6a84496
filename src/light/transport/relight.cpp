#include "light/transport/relight.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kPatches = SkyPatches::kCount;

/// The sky in whole numbers: sums of products with the coefficients' bytes are exact, in any order.
struct WholeSky {
  /// 255 · 32767 · kCount stays below 2³¹.
  alignas(64) std::array<std::array<std::int16_t, kPatches>, 3> patches;
  std::array<float, 3> scale;

  explicit WholeSky(const std::array<Eigen::Array3f, kPatches>& luminances) {
    for (int c = 0; c < 3; ++c) {
      float largest = 0.0f;
      for (const Eigen::Array3f& luminance : luminances) largest = std::max(largest, luminance[c]);
      const auto channel = static_cast<std::size_t>(c);
      scale[channel] = largest / 32767.0f;
      for (std::size_t p = 0; p < kPatches; ++p) {
        patches[channel][p] =
            largest > 0.0f ? static_cast<std::int16_t>(std::lround(luminances[p][c] / largest * 32767.0f))
                           : 0;
      }
    }
  }

  Eigen::Array3f times(const std::uint8_t* row) const {
    std::int32_t r = 0, g = 0, b = 0;
    for (std::size_t p = 0; p < kPatches; ++p) {
      const auto coefficient = static_cast<std::int16_t>(row[p]);
      r += static_cast<std::int32_t>(coefficient) * patches[0][p];
      g += static_cast<std::int32_t>(coefficient) * patches[1][p];
      b += static_cast<std::int32_t>(coefficient) * patches[2][p];
    }
    return {static_cast<float>(r) * scale[0], static_cast<float>(g) * scale[1],
            static_cast<float>(b) * scale[2]};
  }
};

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
  const WholeSky sky(SkyPatches::luminances(day));
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
