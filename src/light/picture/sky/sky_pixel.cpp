#include "light/picture/sky/sky_pixel.h"

#include <algorithm>

namespace sunlit::light {
namespace {

/// How far, in parts of it, the sky in the middle of a cell may be from the mean of its corners.
constexpr float kMostBent = 1e-3f;

}  // namespace

struct SkyPixel::Cell {
  const Tile& tile;
  int row, column;

  int left() const { return tile.x + column * kCell; }
  int top() const { return tile.y + row * kCell; }
  template <typename AnyCorners>
  auto& corner(AnyCorners& corners, int down, int right) const {
    return corners[static_cast<std::size_t>(row + down)][static_cast<std::size_t>(column + right)];
  }
  /// At a pixel's middle.
  Eigen::Array3f between(const Corners& corners, int x, int y) const {
    const float right = (static_cast<float>(x - left()) + 0.5f) / kCell;
    const float down = (static_cast<float>(y - top()) + 0.5f) / kCell;
    const auto along = [&](int side) {
      const Eigen::Array3f& from = corner(corners, side, 0).luminance;
      return Eigen::Array3f(from + right * (corner(corners, side, 1).luminance - from));
    };
    const Eigen::Array3f above = along(0);
    return above + down * (along(1) - above);
  }
};

SkyPixel::SkyPixel(const Surfaces& surfaces, const sky::Daylight& day)
    : surfaces_(surfaces),
      daylight_(day.seenFrom(surfaces.eye)),
      sun_(surfaces, daylight_.sunSeen()),
      moon_(surfaces, daylight_.moonSeen()),
      stars_(surfaces, daylight_, moon_) {}

Eigen::Array3f SkyPixel::luminance(int x, int y) const {
  const Eigen::Vector3f direction = surfaces_.towards(static_cast<float>(x), static_cast<float>(y));
  Eigen::Array3f sum = daylight_.skyLuminance(direction).value;
  if (sun_.near(direction)) sum += sun_.luminance(x, y);
  if (moon_.near(direction)) sum += moon_.luminance(x, y);
  return sum;
}

void SkyPixel::addTo(const Tile& tile, image::LinearImage* image) const {
  if (std::all_of(tile.sky.begin(), tile.sky.end(), [](std::uint8_t samples) { return samples == 0; }))
    return;
  Corners corners;
  for (int row = 0; row * kCell < tile.height; ++row) {
    for (int column = 0; column * kCell < tile.width; ++column) addCell({tile, row, column}, &corners, image);
  }
  for (const StarField::Spot& spot : stars_.in(tile)) {
    Eigen::Map<Eigen::Array3f> pixel(image->at(spot.x, spot.y));
    pixel += spot.luminance * skyShare(tile, spot.x, spot.y);
  }
}

void SkyPixel::addCell(const Cell& cell, Corners* corners, image::LinearImage* image) const {
  enum { kUnknown, kSmooth, kNot } kind = kUnknown;
  for (int y = cell.top(); y < std::min(cell.top() + kCell, cell.tile.y + cell.tile.height); ++y) {
    for (int x = cell.left(); x < std::min(cell.left() + kCell, cell.tile.x + cell.tile.width); ++x) {
      if (skySamples(cell.tile, x, y) == 0) continue;
      if (kind == kUnknown) kind = smooth(cell, corners) ? kSmooth : kNot;
      Eigen::Map<Eigen::Array3f> pixel(image->at(x, y));
      pixel += (kind == kSmooth ? cell.between(*corners, x, y) : luminance(x, y)) * skyShare(cell.tile, x, y);
    }
  }
}

bool SkyPixel::smooth(const Cell& cell, Corners* corners) const {
  const float left = static_cast<float>(cell.left()) - 0.5f, top = static_cast<float>(cell.top()) - 0.5f;
  constexpr float kHalf = 0.5f * kCell;
  const Eigen::Vector3f middle = surfaces_.towards(left + kHalf, top + kHalf);
  if (sun_.near(middle) || moon_.near(middle)) return false;
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int i = 0; i < 4; ++i) {
    Corner& corner = cell.corner(*corners, i / 2, i % 2);
    if (!corner.known) {
      const Eigen::Vector3f direction = surfaces_.towards(left + static_cast<float>(i % 2 * kCell),
                                                          top + static_cast<float>(i / 2 * kCell));
      corner = {daylight_.skyLuminance(direction).value, direction.z(), true};
    }
    // At the horizon it breaks off.
    if (corner.height <= 0.0f) return false;
    sum += corner.luminance;
  }
  const Eigen::Array3f exact = daylight_.skyLuminance(middle).value;
  return ((0.25f * sum - exact).abs() <= kMostBent * exact).all();
}

int SkyPixel::skySamples(const Tile& tile, int x, int y) {
  return tile.sky[static_cast<std::size_t>((y - tile.y) * tile.width + (x - tile.x))];
}

Eigen::Array3f SkyPixel::skyShare(const Tile& tile, int x, int y) const {
  const float share =
      static_cast<float>(skySamples(tile, x, y)) / static_cast<float>(surfaces_.samples_per_pixel);
  if (tile.sky_share.empty()) return Eigen::Array3f::Constant(share);
  return share * tile.sky_share[static_cast<std::size_t>((y - tile.y) * tile.width + (x - tile.x))];
}

}  // namespace sunlit::light
