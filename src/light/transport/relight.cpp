#include "light/transport/relight.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "light/patch_sky.h"
#include "light/transport/lamp_bounces.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

/// Of an even sphere's light: surfaces that hide less are too few to tell how bright they are.
constexpr float kLeastHidden = 0.02f;

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

/// What lights the samples of a scene.
class Lights {
 public:
  explicit Lights(const sky::Daylight& day)
      : sky_(SkyPatches::luminances(day, SkyPatches::Weight::kCosine)), sun_(day.sun()), moon_(day.moon()) {}

  /// Illuminance of a sample by the sky that it sees, lx.
  Eigen::Array3f direct(const Coefficients& direct, std::size_t sample) const {
    return sky_.times(direct.row(sample)) * direct.scales[sample];
  }
  /// The part of it from below the horizon, where no surface lies.
  Eigen::Array3f fromBelow(float coefficient) const {
    return sky_.luminance(SkyPatches::kBelow) * coefficient;
  }
  /// And by surfaces.
  Eigen::Array3f passedOn(const PassedOn& part, std::size_t sample) const {
    const std::uint8_t* row = part.coefficients.row(sample);
    const Eigen::Array3f tint = Eigen::Map<const Eigen::Array3f>(part.tints[sample].data());
    return (sky_.times(row) + sun_.times(row) + moon_.times(row)) *
               (part.coefficients.scales[sample] * tint) +
           Eigen::Map<const Eigen::Array3f>(part.glows[sample].data());
  }

 private:
  PatchSky sky_;
  SmallLight sun_, moon_;
};

/// Mean luminance of surfaces that hide the share `hides` and give `illuminance`, lx.
Eigen::Array3f meanLuminance(const Eigen::Array3f& illuminance, float hides) {
  // Where next to nothing is hidden, rounding must not make it shine.
  return illuminance / (kPiFloat * std::max(hides, kLeastHidden));
}

/// Where a part hides next to nothing, it is taken as bright as both are together.
Surroundings surroundingsOf(const Eigen::Array3f& above, float hides_above, const Eigen::Array3f& below,
                            float hides_below) {
  const Eigen::Array3f both = meanLuminance(above + below, hides_above + hides_below);
  const auto known = [](float hides) { return std::min(hides / kLeastHidden, 1.0f); };
  return {meanLuminance(above, hides_above) + (1.0f - known(hides_above)) * both,
          meanLuminance(below, hides_below) + (1.0f - known(hides_below)) * both};
}

/// By lamps, of every sample; empty: none burns.
using ByLamps = std::vector<BakedLamps::Light>;

SUNLIT_WIDE_VECTOR_CLONES
void lightSamples(const TransportData& data, const Lights& lights, const ByLamps& by_lamps,
                  const tbb::blocked_range<std::size_t>& samples, NodeLight* light) {
  const std::size_t end = samples.end();
  for (std::size_t i = samples.begin(); i != end; ++i) {
    Eigen::Array3f above = lights.passedOn(data.above, i);
    Eigen::Array3f below = lights.passedOn(data.below, i);
    if (!by_lamps.empty()) {
      above += Eigen::Map<const Eigen::Array3f>(by_lamps[i].data());
      below += Eigen::Map<const Eigen::Array3f>(by_lamps[i].data() + 3);
    }
    const float open = data.direct.row(i)[SkyPatches::kBelow] * data.direct.scales[i];
    light[i] = {lights.direct(data.direct, i) + above + below,
                surroundingsOf(above, data.above.hides[i], below + lights.fromBelow(open),
                               data.below.hides[i] + open / kPiFloat)};
  }
}

ByLamps lampLight(const TransportData& data, const std::vector<float>& shares) {
  ByLamps light;
  for (std::size_t set = 0; set < std::min(shares.size(), data.lamps.setCount()); ++set) {
    if (!(shares[set] > 0.0f)) continue;
    light.resize(data.sampleCount(), BakedLamps::Light{});
    addLamps(data.lamps, set, shares[set], &light);
  }
  return light;
}

std::vector<NodeLight> sampleLight(const TransportData& data, const sky::Daylight& day,
                                   const std::vector<float>& lamp_shares) {
  const Lights lights(day);
  const ByLamps by_lamps = lampLight(data, lamp_shares);
  std::vector<NodeLight> light(data.sampleCount());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, light.size(), 1024),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      lightSamples(data, lights, by_lamps, range, light.data());
                    });
  return light;
}

}  // namespace

std::vector<NodeLight> relight(const TransportData& data, const sky::Daylight& day,
                               const std::vector<float>& lamp_shares) {
  const std::vector<NodeLight> samples = sampleLight(data, day, lamp_shares);
  const LightMesh& mesh = data.mesh;
  std::vector<NodeLight> nodes(mesh.nodeCount());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, nodes.size(), 4096),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t n = range.begin(); n != range.end(); ++n) {
          NodeLight sum{Eigen::Array3f::Zero(), {Eigen::Array3f::Zero(), Eigen::Array3f::Zero()}};
          for (std::uint32_t s = mesh.first_share[n]; s < mesh.first_share[n + 1]; ++s) {
            const NodeLight& sample = samples[mesh.shares[s].sample];
            const float weight = mesh.shares[s].weight;
            sum.irradiance += sample.irradiance * weight;
            sum.around.above += sample.around.above * weight;
            sum.around.below += sample.around.below * weight;
          }
          nodes[n] = sum;
        }
      });
  return nodes;
}

}  // namespace sunlit::light
