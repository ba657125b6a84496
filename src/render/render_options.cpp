#include <algorithm>
#include <string>

#include "sunlit/render/renderer.h"

namespace sunlit::render {

void validate(const RenderOptions& options) {
  requireFields(options);
  image::requireCoefficients(options.distortion, "distortion_coefficients");
  if (!options.distortion.none()) static_cast<void>(image::Lens(options.camera, options.distortion).widest());
  require("far", options.far_m, Range::above(options.near_m, 1e7), "m");
  // Samples a side: products of two places in the picture then stay exact, see ScreenProjection and
  // TileRaster.
  constexpr int kMaxSamples = 16384;
  if (std::max(options.camera.width, options.camera.height) * options.supersampling > kMaxSamples) {
    refuse("supersampling", std::to_string(options.supersampling),
           "such that width and height times supersampling are at most " + std::to_string(kMaxSamples));
  }
}

}  // namespace sunlit::render
