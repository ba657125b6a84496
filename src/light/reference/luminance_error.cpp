#include "sunlit/light/luminance_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

/// Fainter than this share of the mean is black beside the rest of the picture, in print and on a screen.
constexpr double kFloorShare = 1e-3;

double luminanceOf(const image::LinearImage& image, std::size_t pixel) {
  const float* rgb = image.data.data() + 3 * pixel;
  return static_cast<double>(LinearRgb(rgb[0], rgb[1], rgb[2]).luminance());
}

/// Pixels that see a surface, in increasing order.
std::vector<std::size_t> pixelsOf(const Surfaces& surfaces) {
  std::vector<bool> sees(static_cast<std::size_t>(surfaces.width) *
                         static_cast<std::size_t>(surfaces.height));
  for (const Tile& tile : surfaces.tiles) {
    for (const Surface& surface : tile.surfaces) sees[surface.pixel] = true;
  }
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < sees.size(); ++i) {
    if (sees[i]) pixels.push_back(i);
  }
  return pixels;
}

struct Comparison {
  Comparison(const image::LinearImage& picture_to_test, const Traced& reference_to_use,
             const Surfaces& surfaces)
      : picture(picture_to_test), reference(reference_to_use), pixels(pixelsOf(surfaces)) {
    const image::LinearImage& other = reference.luminance;
    if (picture.width != other.width || picture.height != other.height || picture.width != surfaces.width ||
        picture.height != surfaces.height) {
      throw std::invalid_argument("picture, reference and surfaces differ in size");
    }
    for (const std::size_t pixel : pixels) mean += luminanceOf(other, pixel);
    if (!pixels.empty()) mean /= static_cast<double>(pixels.size());
    floor = kFloorShare * mean;
  }
  double divisor(std::size_t pixel) const {
    return std::max({luminanceOf(reference.luminance, pixel), floor, 1e-30});
  }
  double error(std::size_t pixel) const {
    return (luminanceOf(picture, pixel) - luminanceOf(reference.luminance, pixel)) / divisor(pixel);
  }

  const image::LinearImage& picture;
  const Traced& reference;
  std::vector<std::size_t> pixels;
  double mean = 0.0, floor = 0.0;
};

}  // namespace

LuminanceError luminanceError(const image::LinearImage& picture, const Traced& reference,
                              const Surfaces& surfaces) {
  const Comparison comparison(picture, reference, surfaces);
  LuminanceError result;
  // Beside black nothing has a relative error.
  if (comparison.pixels.empty() || !(comparison.mean > 0.0)) return result;
  std::vector<double> errors;
  double difference = 0.0, noise = 0.0;
  for (const std::size_t pixel : comparison.pixels) {
    const double error = comparison.error(pixel);
    errors.push_back(std::abs(error));
    result.mean += std::abs(error);
    difference += error * comparison.divisor(pixel);
    noise += static_cast<double>(reference.noise.data[pixel]) / comparison.divisor(pixel);
  }
  const auto count = static_cast<double>(errors.size());
  std::sort(errors.begin(), errors.end());
  const auto quantile = [&](double q) { return errors[static_cast<std::size_t>(q * (count - 1.0) + 0.5)]; };
  result.pixels = errors.size();
  result.mean /= count;
  result.median = quantile(0.5);
  result.p95 = quantile(0.95);
  result.bias = comparison.mean > 0.0 ? difference / count / comparison.mean : 0.0;
  result.noise = noise / count;
  result.floor_cd_per_m2 = comparison.floor;
  return result;
}

image::Picture<float, 1> relativeErrors(const image::LinearImage& picture, const Traced& reference,
                                        const Surfaces& surfaces) {
  const Comparison comparison(picture, reference, surfaces);
  image::Picture<float, 1> errors(picture.width, picture.height);
  for (const std::size_t pixel : comparison.pixels) {
    errors.data[pixel] = static_cast<float>(comparison.error(pixel));
  }
  return errors;
}

}  // namespace sunlit::light
