#include <stdexcept>
#include <string>

#include "sunlit/light/final_gather.h"
#include "sunlit/render/renderer.h"

namespace sunlit::render {
namespace {

/// Samples a side: products of two places in the picture then stay exact, see ScreenProjection and
/// TileRaster.
constexpr int kMaxSamples = 16384;

void require(bool good, const std::string& key, double value, const std::string& range) {
  if (good) return;
  throw std::invalid_argument(key + " is " + std::to_string(value) + ", must be " + range);
}

}  // namespace

void validate(const RenderOptions& options) {
  const image::PinholeCamera& camera = options.camera;
  require(camera.width >= 16 && camera.width <= 8192, "camera.width", camera.width, "16 ... 8192");
  require(camera.height >= 16 && camera.height <= 8192, "camera.height", camera.height, "16 ... 8192");
  require(camera.fx > 0.0 && camera.fx < 1e6, "camera.fx", camera.fx, "above 0 and below 1e6");
  require(camera.fy > 0.0 && camera.fy < 1e6, "camera.fy", camera.fy, "above 0 and below 1e6");
  require(camera.cx > -1e5 && camera.cx < 1e5, "camera.cx", camera.cx, "within +-1e5");
  require(camera.cy > -1e5 && camera.cy < 1e5, "camera.cy", camera.cy, "within +-1e5");
  require(options.supersampling >= 1 && options.supersampling <= 4, "supersampling", options.supersampling,
          "1 ... 4");
  const std::string size =
      "such that width and height times supersampling are at most " + std::to_string(kMaxSamples);
  require(camera.width * options.supersampling <= kMaxSamples &&
              camera.height * options.supersampling <= kMaxSamples,
          "supersampling", options.supersampling, size);
  require(options.near_m > 0.0 && options.near_m < 1e6, "near_m", options.near_m, "above 0 and below 1e6");
  require(options.far_m > options.near_m && options.far_m <= 1e7, "far_m", options.far_m,
          "above near_m, at most 1e7");
  require(options.texture_lod_bias >= -4.0 && options.texture_lod_bias <= 4.0, "texture_lod_bias",
          options.texture_lod_bias, "-4 ... 4");
  require(options.final_gather >= 0 && options.final_gather <= light::FinalGather::kMostRays, "final_gather",
          options.final_gather, "0 ... 16");
}

}  // namespace sunlit::render
