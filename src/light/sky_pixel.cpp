#include "light/sky_pixel.h"

namespace sunlit::light {

SkyPixel::SkyPixel(const Surfaces& surfaces, const sky::Daylight& day)
    : surfaces_(surfaces),
      daylight_(day),
      sun_(surfaces, day.sun()),
      moon_(surfaces, day.moon()),
      stars_(surfaces, day, moon_) {}

Eigen::Array3f SkyPixel::luminance(int x, int y) const {
  const Eigen::Vector3f towards = (surfaces_.pixel_origin + static_cast<float>(x) * surfaces_.pixel_right +
                                   static_cast<float>(y) * surfaces_.pixel_down)
                                      .normalized();
  Eigen::Array3f sum = daylight_.skyLuminance(towards).value;
  if (sun_.near(towards)) sum += sun_.luminance(x, y);
  if (moon_.near(towards)) sum += moon_.luminance(x, y);
  return sum;
}

void SkyPixel::addTo(const Tile& tile, image::LinearImage* image) const {
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const float share = skyShare(tile, x, y);
      if (share == 0.0f) continue;
      Eigen::Map<Eigen::Array3f> pixel(image->at(x, y));
      pixel += luminance(x, y) * share;
    }
  }
  for (const StarField::Spot& spot : stars_.in(tile)) {
    Eigen::Map<Eigen::Array3f> pixel(image->at(spot.x, spot.y));
    pixel += spot.luminance * skyShare(tile, spot.x, spot.y);
  }
}

float SkyPixel::skyShare(const Tile& tile, int x, int y) const {
  const int place = (y - tile.y) * tile.width + (x - tile.x);
  const auto samples = tile.sky[static_cast<std::size_t>(place)];
  return static_cast<float>(samples) / static_cast<float>(surfaces_.samples_per_pixel);
}

}  // namespace sunlit::light
