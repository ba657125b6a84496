#include "light/bake/gather/relight.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "light/bake/gather/discs_in_rooms.h"
#include "light/bake/gather/lamp_bounces.h"
#include "light/bake/gather/small_light.h"
#include "light/bake/gather/through_cloud.h"
#include "light/patches/patch_sky.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

/// Of an even sphere's light: surfaces that hide less are too few to tell how bright they are.
constexpr float kLeastHidden = 0.02f;

/// What lights the samples of a scene.
class Lights {
 public:
  /// Keeps a reference to `through`.
  Lights(const sky::Daylight& day, const DiscsThroughCloud& through)
      : sky_(SkyPatches::luminances(day, SkyPatches::Weight::kCosine)),
        sun_(day.sun()),
        moon_(day.moon()),
        through_(through) {}

  /// Illuminance of a sample by the sky that it sees, lx.
  Eigen::Array3f direct(const TransportData& data, std::size_t sample) const {
    return data.directTint(sample).times(sky_.times(data.direct.row(sample)) * data.direct.scales[sample]);
  }
  /// The part of it from below the horizon, where no surface lies.
  Eigen::Array3f fromBelow(float coefficient) const {
    return sky_.luminance(SkyPatches::kBelow) * coefficient;
  }
  /// And by surfaces.
  Eigen::Array3f passedOn(const PassedOn& part, std::size_t sample) const {
    const std::uint8_t* row = part.coefficients.row(sample);
    return coloured(sky_.times(row) + sun_.times(row) * through_.sun.at(sample) +
                        moon_.times(row) * through_.moon.at(sample),
                    part, sample);
  }
  /// The same without sun and moon.
  Eigen::Array3f ofSky(const PassedOn& part, std::size_t sample) const {
    return coloured(sky_.times(part.coefficients.row(sample)), part, sample);
  }

 private:
  static Eigen::Array3f coloured(const Eigen::Array3f& by_row, const PassedOn& part, std::size_t sample) {
    const Eigen::Array3f tint = Eigen::Map<const Eigen::Array3f>(part.tints[sample].data());
    return by_row * (part.coefficients.scales[sample] * tint) +
           Eigen::Map<const Eigen::Array3f>(part.glows[sample].data());
  }

  PatchSky sky_;
  SmallLight sun_, moon_;
  const DiscsThroughCloud& through_;
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

/// A sample's light from surfaces above the horizon and below it, lx.
struct FromSurfaces {
  Eigen::Array3f above, below;
};

NodeLight lightOf(const TransportData& data, const Lights& lights, std::size_t sample,
                  const FromSurfaces& from) {
  const float open = data.direct.row(sample)[SkyPatches::kBelow] * data.direct.scales[sample];
  return {lights.direct(data, sample) + from.above + from.below,
          surroundingsOf(from.above, data.above.hides[sample], from.below + lights.fromBelow(open),
                         data.below.hides[sample] + open / kPiFloat)};
}

void addLampsTo(FromSurfaces* from, const ByLamps& by_lamps, std::size_t sample) {
  if (by_lamps.empty()) return;
  from->above += Eigen::Map<const Eigen::Array3f>(by_lamps[sample].data());
  from->below += Eigen::Map<const Eigen::Array3f>(by_lamps[sample].data() + 3);
}

SUNLIT_WIDE_VECTOR_CLONES
void lightSamples(const TransportData& data, const Lights& lights, const ByLamps& by_lamps,
                  const tbb::blocked_range<std::size_t>& samples, NodeLight* light) {
  const std::size_t end = samples.end();
  for (std::size_t i = samples.begin(); i != end; ++i) {
    FromSurfaces from{lights.passedOn(data.above, i), lights.passedOn(data.below, i)};
    addLampsTo(&from, by_lamps, i);
    light[i] = lightOf(data, lights, i, from);
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

std::vector<NodeLight> sampleLight(const TransportData& data, const Conditions& conditions) {
  const Geometry* const geometry = conditions.visibility ? &conditions.visibility->fixedGeometry() : nullptr;
  const DiscsThroughCloud through(data, geometry, conditions.day);
  const Lights lights(conditions.day, through);
  const ByLamps by_lamps = lampLight(data, conditions.lamp_shares);
  std::vector<NodeLight> light(data.sampleCount());
  constexpr std::size_t kInMemory = 1u << 16;  // samples: some 40 MB of the file at a time
  for (std::size_t begin = 0; begin < light.size(); begin += kInMemory) {
    const std::size_t end = std::min(begin + kInMemory, light.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        lightSamples(data, lights, by_lamps, range, light.data());
                      });
    data.letGoOfRows(begin, end);
  }
  if (!conditions.visibility) return light;
  const DiscsInRooms discs(data, conditions.day, *conditions.visibility, through);
  if (discs.none()) return light;
  tbb::parallel_for(std::size_t{0}, data.rooms.samples.size(), [&](std::size_t room) {
    const std::uint32_t sample = data.rooms.samples[room];
    FromSurfaces from{lights.ofSky(data.above, sample) + discs.at(room).above,
                      lights.ofSky(data.below, sample) + discs.at(room).below};
    addLampsTo(&from, by_lamps, sample);
    light[sample] = lightOf(data, lights, sample, from);
  });
  return light;
}

}  // namespace

std::vector<NodeLight> relight(const TransportData& data, const Conditions& conditions) {
  const std::vector<NodeLight> samples = sampleLight(data, conditions);
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
