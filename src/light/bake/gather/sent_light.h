/// Light that samples have from each other, and what they send on of it.
#pragma once

#include <Eigen/Core>
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

/// By the sum over the patches of the sky: what a sample sends, as luminance × π.
struct SentSums {
  Eigen::Array3f color;  ///< of light of the sky
  Eigen::Array3f glow;   ///< of what shines by itself, that it reflects
};

/// Likewise, light that a sample has from the surfaces of one part, as illuminance.
struct PartSums {
  Eigen::Array3f color = Eigen::Array3f::Zero(), glow = Eigen::Array3f::Zero();
};
struct PassedOnSums {
  PartSums above, below;
  Eigen::Array3f color() const { return above.color + below.color; }
  Eigen::Array3f glow() const { return above.glow + below.glow; }
};
/// Illuminance by surfaces, lx.
struct Arrived {
  Eigen::Array3f above = Eigen::Array3f::Zero(), below = Eigen::Array3f::Zero();
};

/// Of every sample.
struct SumsOfAll {
  std::vector<float> direct;
  std::vector<PassedOnSums> passed_on;
};
SumsOfAll sumsOf(const TransportData& data);

/// Writes tint and glow of a sample's part, not its coefficients.
void store(const PartSums& sums, std::size_t sample, PassedOn* part);

}  // namespace sunlit::light
