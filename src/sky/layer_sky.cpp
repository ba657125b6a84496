#include "layer_sky.h"

#include <algorithm>
#include <cmath>

#include "hemisphere.h"
#include "quadrature.h"
#include "sphere.h"
#include "table_place.h"

namespace sunlit::sky {
namespace {

float rowElevation(int row, int rows) {
  const float t = static_cast<float>(row) / static_cast<float>(rows - 1);
  return kHalfPi * t * t;
}

Eigen::Vector3f at(float elevation, float azimuth) {
  const float across = std::cos(elevation);
  return {across * std::cos(azimuth), across * std::sin(azimuth), std::sin(elevation)};
}

/// Of light from all round at one height, scattered once.
float onceAllRound(const DropletLayer& layer, float mu, float mu0) {
  constexpr int kAzimuths = 24;
  const float both = std::sqrt((1.0F - mu * mu) * (1.0F - mu0 * mu0));
  const DropletLayer::Once once = layer.once(mu, mu0);
  float sum = 0.0F;
  for (int i = 0; i < kAzimuths; ++i) {
    const auto azimuth = static_cast<float>(kPi * (i + 0.5) / kAzimuths);
    sum += once.under(std::min(1.0F, mu * mu0 + both * std::cos(azimuth)));
  }
  return sum / kAzimuths;
}

}  // namespace

Eigen::Array3f levelOf(const LightAbove& above) {
  Eigen::Array3f level = levelIlluminance(hemisphere(Eigen::Vector2f::UnitY()), above.luminance);
  for (const DiscLight& disc : above.discs) level += onLevelGround(disc);
  return level;
}

LayerSky::LayerSky(const DropletLayer& layer, const LightAbove& above)
    : depth_(layer.opticalDepth()),
      nodes_(static_cast<std::size_t>(kRows * kColumns), Eigen::Array4f::Zero()) {
  addSky(layer, above);
  for (const DiscLight& disc : above.discs) addDisc(layer, disc);
  Eigen::Array4f blued = Eigen::Array4f::Ones();
  blued.head<3>() = layer.bluing();
  for (Eigen::Array4f& node : nodes_) node *= blued;
  level_ = levelBelow(layer, above);
}

LayerSky::LayerSky(const DropletLayer& layer, const LightAbove& above, float albedo_below)
    : LayerSky(layer, above) {
  const float both = 1.0F - albedo_below * layer.sphericalAlbedo();
  addFromBelow(layer, level_ * (albedo_below / (both * static_cast<float>(kPi))));
}

float LayerSky::passed(float z) const {
  return passedStraight(depth_, z);
}

float LayerSky::stopped(float z) const {
  return stoppedOf(depth_, z);
}

void LayerSky::addSky(const DropletLayer& layer, const LightAbove& above) {
  struct Belt {
    float mu, angle;
    Eigen::Array3f illuminance;  // of planes facing it, all round together
  };
  constexpr int kFacingBelts = 24;
  constexpr int kAzimuths = 24;
  std::vector<Belt> belts;
  for (const Node& node : gaussLegendre(kFacingBelts, 0.0, 1.0)) {
    const auto mu = static_cast<float>(node.x);
    const float angle = std::acos(mu);
    Eigen::Array3f mean = Eigen::Array3f::Zero();
    for (int i = 0; i < kAzimuths; ++i)
      mean += above.luminance(at(kHalfPi - angle, static_cast<float>(2.0 * kPi * (i + 0.5) / kAzimuths)));
    belts.push_back({mu, angle, mean * static_cast<float>(2.0 * kPi * node.weight / kAzimuths)});
  }
  for (int row = 0; row < kRows; ++row) {
    const float elevation = rowElevation(row, kRows);
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    for (const Belt& belt : belts) {
      const float share =
          layer.evenMode(kHalfPi - elevation, belt.angle) + onceAllRound(layer, std::sin(elevation), belt.mu);
      sum.head<3>() += belt.illuminance * share;
    }
    for (int column = 0; column < kColumns; ++column)
      nodes_[static_cast<std::size_t>(row * kColumns + column)] += sum;
  }
}

void LayerSky::addDisc(const DropletLayer& layer, const DiscLight& disc) {
  const Eigen::Vector3f towards = disc.towards.vector().cast<float>();
  if (disc.illuminance.value.maxCoeff() <= 0.0F) return;
  // A disc that is setting still shines a little from above.
  const float mu0 = std::max(towards.z(), 1e-3F);
  const float lit = std::acos(std::min(mu0, 1.0F));
  const Eigen::Vector2f heading = headingOf(towards);
  Eigen::Array4f light = Eigen::Array4f::Zero();
  light.head<3>() = disc.illuminance.value;
  for (int row = 0; row < kRows; ++row) {
    const float elevation = rowElevation(row, kRows);
    const auto modes = layer.modes(kHalfPi - elevation, lit);
    const DropletLayer::Once once = layer.once(std::sin(elevation), mu0);
    for (int column = 0; column < kColumns; ++column) {
      const Eigen::Vector3f seen = at(elevation, static_cast<float>(2.0 * kPi * column / kColumns));
      const float turn = azimuthFrom(heading, seen);
      // Chebyshev: cos(mφ) of the two before.
      const float cosine = std::cos(turn);
      float before = 1.0F, now = cosine;
      float sum = modes[0];
      for (std::size_t mode = 1; mode < modes.size(); ++mode) {
        sum += modes[mode] * now;
        const float next = 2.0F * cosine * now - before;
        before = now;
        now = next;
      }
      sum += once.under(std::clamp(seen.dot(towards), -1.0F, 1.0F));
      nodes_[static_cast<std::size_t>(row * kColumns + column)] += light * std::max(0.0F, sum);
    }
  }
}

Eigen::Array3f LayerSky::levelBelow(const DropletLayer& layer, const LightAbove& above) const {
  Eigen::Array3f level =
      levelIlluminance(hemisphere(Eigen::Vector2f::UnitY()), [&](const Eigen::Vector3f& towards) {
        const float straight = layer.passed(towards.z());
        Eigen::Array3f sum = scattered(towards);
        if (straight > 1e-6F) sum += above.luminance(towards) * straight;
        return sum;
      });
  for (const DiscLight& disc : above.discs)
    level += onLevelGround(disc) * layer.passed(static_cast<float>(disc.towards.vector().z()));
  return level;
}

void LayerSky::addFromBelow(const DropletLayer& layer, const Eigen::Array3f& luminance_below) {
  Eigen::Array4f below = Eigen::Array4f::Zero();
  below.head<3>() = luminance_below;
  for (int row = 0; row < kRows; ++row) {
    const float share = layer.reflected(kHalfPi - rowElevation(row, kRows));
    for (int column = 0; column < kColumns; ++column)
      nodes_[static_cast<std::size_t>(row * kColumns + column)] += below * share;
  }
}

LayerSky::Place LayerSky::placeOf(const Eigen::Vector3f& towards) {
  const float elevation = elevationAboveHorizon(towards);
  const TablePlace row = placeAt(std::sqrt(elevation / kHalfPi) * (kRows - 1), kRows);
  const float from_east = azimuthFrom(Eigen::Vector2f::UnitX(), towards);
  const float azimuth = towards.y() >= 0.0F ? from_east : static_cast<float>(2.0 * kPi) - from_east;
  const float at_column = azimuth * static_cast<float>(kColumns / (2.0 * kPi));
  const int column = std::min(static_cast<int>(at_column), kColumns - 1);
  const float u = std::min(at_column - static_cast<float>(column), 1.0F);
  const float v = row.fraction;
  return {row.index * kColumns,
          column,
          column + 1 == kColumns ? 0 : column + 1,
          {(1.0F - u) * (1.0F - v), u * (1.0F - v), (1.0F - u) * v, u * v}};
}

Eigen::Array3f LayerSky::scattered(const Place& place) const {
  const Eigen::Array4f* low = &nodes_[static_cast<std::size_t>(place.row)];
  const Eigen::Array4f* high = low + kColumns;
  const Eigen::Array4f sum = low[place.column] * place.weights[0] + low[place.next] * place.weights[1] +
                             high[place.column] * place.weights[2] + high[place.next] * place.weights[3];
  return sum.head<3>();
}

}  // namespace sunlit::sky
