/// Light that samples have from each other, and what they send on of it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// What a sample reflects of its own light, and passes on of that of the other side of its sheet.
struct Sending {
  Eigen::Array3f direct, bounced;  ///< shares of light straight from the sky, and of other surfaces'
  Eigen::Array3f lamps;            ///< of light straight from lamps and surfaces that shine by themselves
  Eigen::Array3f through;
  std::uint32_t other;  ///< the sample on the other side, or LightMesh::kNone
};

/// Light of several sources, each by itself: a colour in each column.
template <int kSources>
using Colors = Eigen::Array<float, 3, kSources>;

/// Illuminance by surfaces, lx, of several sources.
template <int kSources>
struct ArrivedOf {
  Colors<kSources> above = Colors<kSources>::Zero(), below = Colors<kSources>::Zero();
  Colors<kSources> all() const { return above + below; }
  ArrivedOf& operator+=(const ArrivedOf& more) {
    above += more.above;
    below += more.below;
    return *this;
  }
};
using Arrived = ArrivedOf<1>;

/// Light of several sources that goes from samples to others: luminance × π.
template <int kSources>
struct SentOf {
  explicit SentOf(std::size_t count) : light(count), any(count) {}
  void set(std::size_t number, const Colors<kSources>& value) {
    light[number] = value;
    any[number] = value.isZero(0.0f) ? 0 : 1;
  }
  std::vector<Colors<kSources>> light;
  std::vector<std::uint8_t> any;  ///< whether it is not 0: most are dark, and this fits a core's cache
};

/// What samples have straight from lamps, or from what shines by itself.
struct StraightLight {
  explicit StraightLight(std::size_t samples)
      : direct(samples, Eigen::Array3f::Zero()),
        looked_for(samples, Eigen::Array3f::Zero()),
        lamp_m(samples, 0.0f) {}

  std::vector<Eigen::Array3f> direct;      ///< mean illuminance of the surfaces around each, lx
  std::vector<Eigen::Array3f> looked_for;  ///< of it, as lookedFor() tells
  std::vector<float> lamp_m;               ///< how far off that shines that this is of, in the mean
};

/// By the sum over the patches of the sky, of every sample.
struct SumsOfAll {
  std::vector<Eigen::Array3f> direct;
  std::vector<Arrived> passed_on;
};
SumsOfAll sumsOf(const TransportData& data);

/// Writes the tint of a sample's part, of such a sum; not its coefficients.
void storeTint(const Eigen::Array3f& sum, std::size_t sample, PassedOn* part);

}  // namespace sunlit::light
