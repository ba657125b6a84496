#include "light/bake/gather/relight.h"

#include <algorithm>
#include <atomic>
#include <utility>

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

/// Of what a row of coefficients gives.
Eigen::Array3f coloured(const Eigen::Array3f& by_row, const PassedOn& part, std::size_t sample) {
  const Eigen::Array3f tint = Eigen::Map<const Eigen::Array3f>(part.tints[sample].data());
  return by_row * (part.coefficients.scales[sample] * tint) +
         Eigen::Map<const Eigen::Array3f>(part.glows[sample].data());
}

/// By lamps, of every sample; empty: none burns.
using ByLamps = std::vector<BakedLamps::Light>;

ByLamps lampLight(const TransportData& data, const std::vector<float>& shares) {
  ByLamps light;
  for (std::size_t set = 0; set < std::min(shares.size(), data.lamps.setCount()); ++set) {
    if (!(shares[set] > 0.0f)) continue;
    light.resize(data.sampleCount(), BakedLamps::Light{});
    addLamps(data.lamps, set, shares[set], &light);
  }
  return light;
}

const Geometry* geometryOf(const Conditions& conditions) {
  return conditions.visibility ? &conditions.visibility->fixedGeometry() : nullptr;
}

/// What lights the samples of a scene.
class Lights {
 public:
  Lights(std::shared_ptr<const TransportData> data, const Conditions& conditions)
      : data_(std::move(data)),
        sky_(SkyPatches::luminances(conditions.day, SkyPatches::Weight::kCosine)),
        sun_(conditions.day.sun()),
        moon_(conditions.day.moon()),
        through_(*data_, geometryOf(conditions), conditions.day),
        by_lamps_(lampLight(*data_, conditions.lamp_shares)) {
    if (conditions.visibility)
      in_rooms_ = discsInRooms(*data_, conditions.day, *conditions.visibility, through_);
    data_->letGo();
  }

  const TransportData& data() const { return *data_; }

  NodeLight of(std::size_t sample) const {
    const FromSurfaces from = fromSurfaces(sample);
    const PassedOn& below = data_->below;
    const float open = data_->direct.row(sample)[SkyPatches::kBelow] * data_->direct.scales[sample];
    return {direct(sample) + from.above + from.below,
            surroundingsOf(from.above, data_->above.hides[sample],
                           from.below + sky_.luminance(SkyPatches::kBelow) * open,
                           below.hides[sample] + open / kPiFloat)};
  }

  /// To be called for each `count` nodes that were found: lets go of what was looked at for them.
  void noteFound(std::size_t count) const {
    constexpr std::size_t kKept = 1u << 15;  // nodes, of some 40 MB of the file
    const std::size_t before = found_.fetch_add(count, std::memory_order_relaxed);
    if (before / kKept != (before + count) / kKept) data_->letGoOfRows(0, data_->sampleCount());
  }

 private:
  /// A sample's light from surfaces above the horizon and below it, lx.
  struct FromSurfaces {
    Eigen::Array3f above, below;
  };

  /// Illuminance by the sky that is seen, lx; from below the horizon where no surface lies, too.
  Eigen::Array3f direct(std::size_t sample) const {
    return data_->directTint(sample).times(sky_.times(data_->direct.row(sample)) *
                                           data_->direct.scales[sample]);
  }

  FromSurfaces fromSurfaces(std::size_t sample) const {
    FromSurfaces from;
    if (const Arrived* by_discs = inRoom(sample)) {
      from = {ofSky(data_->above, sample) + by_discs->above, ofSky(data_->below, sample) + by_discs->below};
    } else {
      from = {passedOn(data_->above, sample), passedOn(data_->below, sample)};
    }
    if (!by_lamps_.empty()) {
      from.above += Eigen::Map<const Eigen::Array3f>(by_lamps_[sample].data());
      from.below += Eigen::Map<const Eigen::Array3f>(by_lamps_[sample].data() + 3);
    }
    return from;
  }

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

  /// By sun and moon; null where they are not followed.
  const Arrived* inRoom(std::size_t sample) const {
    if (in_rooms_.empty()) return nullptr;
    const image::KeptArray<std::uint32_t>& rooms = data_->rooms.samples;
    const std::uint32_t* const found = std::lower_bound(rooms.begin(), rooms.end(), sample);
    return found != rooms.end() && *found == sample
               ? &in_rooms_[static_cast<std::size_t>(found - rooms.begin())]
               : nullptr;
  }

  std::shared_ptr<const TransportData> data_;
  PatchSky sky_;
  SmallLight sun_, moon_;
  DiscsThroughCloud through_;
  ByLamps by_lamps_;
  std::vector<Arrived> in_rooms_;  ///< of each room; empty: nothing is known of them
  mutable std::atomic<std::size_t> found_{0};
};

SUNLIT_WIDE_VECTOR_CLONES __attribute__((flatten)) void lightSamples(
    const Lights& lights, const std::vector<std::uint32_t>& samples, NodeLight* light) {
  for (std::size_t k = 0; k < samples.size(); ++k) light[k] = lights.of(samples[k]);
}

void lightNodes(const Lights& lights, std::size_t first, std::size_t end, NodeLight* nodes) {
  const LightMesh& mesh = lights.data().mesh;
  thread_local std::vector<std::uint32_t> samples;
  thread_local std::vector<NodeLight> light;
  samples.clear();
  for (std::uint32_t s = mesh.first_share[first]; s < mesh.first_share[end]; ++s)
    samples.push_back(mesh.shares[s].sample);
  std::sort(samples.begin(), samples.end());
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  light.resize(samples.size());
  lightSamples(lights, samples, light.data());
  for (std::size_t n = first; n != end; ++n) {
    NodeLight sum{Eigen::Array3f::Zero(), {Eigen::Array3f::Zero(), Eigen::Array3f::Zero()}};
    for (std::uint32_t s = mesh.first_share[n]; s < mesh.first_share[n + 1]; ++s) {
      const auto at = std::lower_bound(samples.begin(), samples.end(), mesh.shares[s].sample);
      const NodeLight& sample = light[static_cast<std::size_t>(at - samples.begin())];
      const float weight = mesh.shares[s].weight;
      sum.irradiance += sample.irradiance * weight;
      sum.around.above += sample.around.above * weight;
      sum.around.below += sample.around.below * weight;
    }
    nodes[n - first] = sum;
  }
}

}  // namespace

FindLight relight(std::shared_ptr<const TransportData> data, const Conditions& conditions) {
  const auto lights = std::make_shared<const Lights>(std::move(data), conditions);
  return [lights](std::size_t first, std::size_t end, NodeLight* light) {
    lightNodes(*lights, first, end, light);
    lights->noteFound(end - first);
  };
}

}  // namespace sunlit::light
