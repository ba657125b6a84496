#include "sky_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"
#include "table_place.h"

namespace sunlit::sky {
namespace {

constexpr float kHalfPi = static_cast<float>(0.5 * kPi);

std::size_t nodeIndex(int row, int column, int columns) {
  return static_cast<std::size_t>(row * columns + column);
}

Eigen::Array4f padded(const LinearRgb& colour) {
  return {colour.value[0], colour.value[1], colour.value[2], 0.0F};
}

float rowElevation(float row) {
  const float t = row / static_cast<float>(SkyTable::kRows - 1);
  return kHalfPi * t * t;
}

void fillSky(const Transport& transport, const SkyScene& scene, SkyTable* table) {
  table->sky.resize(static_cast<std::size_t>(SkyTable::kRows * SkyTable::kColumns));
  const double sun_cos_zenith = scene.geometric_sun.vector().z();
  const auto strength = static_cast<float>(1.0 / (scene.distance_au * scene.distance_au));
  const double sun_sin_zenith = std::sqrt(std::max(0.0, 1.0 - sun_cos_zenith * sun_cos_zenith));
  tbb::parallel_for(0, SkyTable::kRows, [&](int row) {
    const double elevation = rowElevation(static_cast<float>(row));
    for (int column = 0; column < SkyTable::kColumns; ++column) {
      const double azimuth = kPi * column / (SkyTable::kColumns - 1);
      const double cos_zenith = std::sin(elevation);
      const double cos_angle =
          cos_zenith * sun_cos_zenith + std::cos(elevation) * sun_sin_zenith * std::cos(azimuth);
      const Scattered light = transport.scattered({scene.altitude_km, cos_zenith, sun_cos_zenith, cos_angle});
      table->sky[nodeIndex(row, column, SkyTable::kColumns)] = {
          padded(inGamut(colourOf(light.smooth * strength))),
          padded(inGamut(colourOf(light.aerosol * strength))),
          padded(inGamut(colourOf(light.aerosol_again * strength)))};
    }
  });
}

/// Octahedral map of the sphere onto the square [−1, 1]²: Cigolle et al. 2014, listing 1. Upper hemisphere in
/// the middle.
Eigen::Vector2f square(const Eigen::Vector3f& n) {
  const float scale = 1.0F / (std::abs(n.x()) + std::abs(n.y()) + std::abs(n.z()));
  const float x = n.x() * scale;
  const float y = n.y() * scale;
  if (n.z() >= 0.0F) {
    return {x, y};
  }
  return {std::copysign(1.0F - std::abs(y), x), std::copysign(1.0F - std::abs(x), y)};
}

Eigen::Vector3f sphere(float x, float y) {
  Eigen::Vector3f n(x, y, 1.0F - std::abs(x) - std::abs(y));
  if (n.z() < 0.0F) {
    n.x() = std::copysign(1.0F - std::abs(y), x);
    n.y() = std::copysign(1.0F - std::abs(x), y);
  }
  return n.normalized();
}

struct Patch {
  Eigen::Vector3f towards;
  Eigen::Array4f light;  // luminance × solid angle, lx
};

/// Elevations of the edges of belts, closer near the horizon, where a sky after sunset is brightest.
float beltEdge(float part) {
  return kHalfPi * part * (0.4F + 0.6F * part);
}

/// The upper hemisphere in patches, small enough that an aureole is no more than a patch or so too bright.
std::vector<Patch, Eigen::aligned_allocator<Patch>> patches(const SkyTable& table) {
  constexpr int kBelts = 40;
  constexpr int kSectors = 64;
  std::vector<Patch, Eigen::aligned_allocator<Patch>> result;
  for (int belt = 0; belt < kBelts; ++belt) {
    // The midpoint in the sine of elevation has the patch's mean cosine on level ground.
    const float low = std::sin(beltEdge(static_cast<float>(belt) / kBelts));
    const float high = std::sin(beltEdge(static_cast<float>(belt + 1) / kBelts));
    const float z = 0.5F * (low + high);
    const float across = std::sqrt(1.0F - z * z);
    const float solid_angle = (high - low) * static_cast<float>(2.0 * kPi / kSectors);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double azimuth = 2.0 * kPi * (sector + 0.5) / kSectors;
      const auto along = static_cast<float>(std::cos(azimuth)) * across;
      const auto aside = static_cast<float>(std::sin(azimuth)) * across;
      const Eigen::Vector2f& heading = table.sun_heading;
      const Eigen::Vector3f towards(heading.x() * along - heading.y() * aside,
                                    heading.y() * along + heading.x() * aside, z);
      result.push_back({towards, padded(LinearRgb(table.luminance(towards) * solid_angle))});
    }
  }
  return result;
}

Eigen::Array4f gather(const std::vector<Patch, Eigen::aligned_allocator<Patch>>& sky,
                      const Eigen::Vector3f& normal) {
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (const Patch& patch : sky) {
    sum += patch.light * std::max(0.0F, patch.towards.dot(normal));
  }
  return sum;
}

void fillIlluminance(float ground_albedo, SkyTable* table) {
  const auto sky = patches(*table);
  const Eigen::Array4f from_sky = gather(sky, Eigen::Vector3f::UnitZ());
  table->ground_illuminance =
      from_sky.head<3>() + table->sun.illuminance.value * std::max(0.0F, table->towards_sun.z());
  table->ground_luminance = table->ground_illuminance * (ground_albedo / static_cast<float>(kPi));
  constexpr int kSide = SkyTable::kNormals;
  table->illuminance.resize(static_cast<std::size_t>(kSide * kSide));
  tbb::parallel_for(0, kSide, [&](int row) {
    for (int column = 0; column < kSide; ++column) {
      const float step = 2.0F / (kSide - 1);
      const Eigen::Vector3f normal =
          sphere(static_cast<float>(column) * step - 1.0F, static_cast<float>(row) * step - 1.0F);
      // Level ground of even brightness fills (1 − n_z) / 2 of what a surface sees.
      const Eigen::Array3f from_ground =
          table->ground_illuminance * (ground_albedo * 0.5F * (1.0F - normal.z()));
      table->illuminance[nodeIndex(row, column, kSide)] =
          gather(sky, normal) + padded(LinearRgb(from_ground));
    }
  });
}

/// Arc cosine of x in [0, 1] within 2e-8: Abramowitz and Stegun 1964, 4.4.46. Inlined, and
/// the same bits with every maths library.
float arcCosine(float x) {
  float sum = -0.0012624911F;
  for (const float coefficient : {0.0066700901F, -0.0170881256F, 0.0308918810F, -0.0501743046F, 0.0889789874F,
                                  -0.2145988016F, 1.5707963050F}) {
    sum = sum * x + coefficient;
  }
  return std::sqrt(1.0F - x) * sum;
}

}  // namespace

Eigen::Array3f SkyTable::luminance(const Eigen::Vector3f& towards) const {
  const float across = std::sqrt(towards.x() * towards.x() + towards.y() * towards.y());
  // Straight up or down every azimuth is the same sky.
  const float ahead =
      across > 0.0F ? (towards.x() * sun_heading.x() + towards.y() * sun_heading.y()) / across : 1.0F;
  const float from_side = arcCosine(std::min(std::abs(ahead), 1.0F));
  const float azimuth = ahead >= 0.0F ? from_side : 2.0F * kHalfPi - from_side;
  const float elevation = std::max(0.0F, kHalfPi - arcCosine(std::clamp(towards.z(), 0.0F, 1.0F)));
  const TablePlace row = placeAt(std::sqrt(elevation / kHalfPi) * (kRows - 1), kRows);
  const TablePlace column = placeAt(azimuth * static_cast<float>((kColumns - 1) / kPi), kColumns);
  const Node* low = &sky[nodeIndex(row.index, column.index, kColumns)];
  const Node* high = low + kColumns;
  const float u = column.fraction;
  const float v = row.fraction;
  const float cos_angle = towards.dot(towards_sun);
  const float once = aerosolPhase(cos_angle);
  const float again = aerosolAgainPhase(cos_angle);
  const auto blend = [&](const Node& node, float weight) -> Eigen::Array4f {
    return (node.smooth + node.aerosol * once + node.aerosol_again * again) * weight;
  };
  const Eigen::Array4f above = blend(low[0], (1.0F - u) * (1.0F - v)) + blend(low[1], u * (1.0F - v)) +
                               blend(high[0], (1.0F - u) * v) + blend(high[1], u * v);
  if (towards.z() >= 0.0F) {
    return above.head<3>();
  }
  // Ground seen from a hill of this height, through haze that takes on the colour of the horizon (Koschmieder
  // 1924).
  constexpr float kEye_km = 0.1F;
  const float distance_km = kEye_km * across / -towards.z();
  const Eigen::Array3f clear = (haze_per_km * -distance_km).exp();
  return above.head<3>() * (1.0F - clear) + ground_luminance * clear;
}

Eigen::Array3f SkyTable::illuminanceOn(const Eigen::Vector3f& normal) const {
  const Eigen::Vector2f place = (square(normal).array() + 1.0F) * (0.5F * (kNormals - 1));
  const TablePlace column = placeAt(place.x(), kNormals);
  const TablePlace row = placeAt(place.y(), kNormals);
  const Eigen::Array4f* low = &illuminance[nodeIndex(row.index, column.index, kNormals)];
  const Eigen::Array4f* high = low + kNormals;
  const float u = column.fraction;
  const float v = row.fraction;
  const Eigen::Array4f sum = low[0] * ((1.0F - u) * (1.0F - v)) + low[1] * (u * (1.0F - v)) +
                             high[0] * ((1.0F - u) * v) + high[1] * (u * v);
  return sum.head<3>();
}

SkyTable makeSkyTable(const Transport& transport, const SkyScene& scene) {
  SkyTable table;
  table.sun = scene.sun;
  table.towards_sun = scene.sun.towards.vector().cast<float>();
  const Eigen::Vector2f heading = table.towards_sun.head<2>();
  table.sun_heading = heading.norm() > 1e-6F ? heading.normalized() : Eigen::Vector2f::UnitY();
  const LocalMedium air = transport.medium().at(scene.altitude_km);
  const LinearRgb clear = colourOf((air.extinction * -1.0F).exp());
  const LinearRgb white = colourOf(Spectrum::Ones());
  table.haze_per_km = -(clear.value / white.value).log();
  fillSky(transport, scene, &table);
  fillIlluminance(static_cast<float>(transport.medium().parameters().ground_albedo), &table);
  return table;
}

}  // namespace sunlit::sky
