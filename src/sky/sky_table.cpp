#include "sky_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "hemisphere.h"
#include "sphere.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/sky/octahedral.h"
#include "table_place.h"

namespace sunlit::sky {
namespace {

const Eigen::Vector3f kOrigin = Eigen::Vector3f::Zero();

std::size_t nodeIndex(int row, int column, int columns) {
  return static_cast<std::size_t>(row * columns + column);
}

Eigen::Array4f padded(const Eigen::Array3f& colour) {
  return {colour[0], colour[1], colour[2], 0.0F};
}

/// A piece of the sky with its light.
struct LitPiece {
  Eigen::Vector3f towards;
  Eigen::Array4f light;  // luminance × solid angle, lx
};
using LitPieces = std::vector<LitPiece, Eigen::aligned_allocator<LitPiece>>;

LitPieces litPieces(const SkyTable& table) {
  LitPieces pieces;
  for (const SkyPiece& piece : hemisphere(headingOf(table.sun.towards.vector().cast<float>())))
    pieces.push_back(
        {piece.towards, padded(table.skyLuminance({piece.towards, kOrigin, 0.0F}) * piece.solid_angle)});
  return pieces;
}

Eigen::Array4f gather(const LitPieces& sky, const Eigen::Vector3f& normal) {
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (const LitPiece& piece : sky) {
    sum += piece.light * std::max(0.0F, piece.towards.dot(normal));
  }
  return sum;
}

}  // namespace

void gatherIlluminance(float ground_albedo, SkyTable* table) {
  const LitPieces sky = litPieces(*table);
  const Eigen::Array4f from_sky = gather(sky, Eigen::Vector3f::UnitZ());
  table->ground_illuminance = from_sky.head<3>() + onLevelGround(table->sun) + onLevelGround(table->moon);
  table->ground_luminance = table->ground_illuminance * (ground_albedo / kPiFloat);
  constexpr int kSide = SkyTable::kNormals;
  table->illuminance.resize(static_cast<std::size_t>(kSide * kSide));
  tbb::parallel_for(0, kSide, [&](int row) {
    for (int column = 0; column < kSide; ++column) {
      const float step = 2.0F / (kSide - 1);
      const Eigen::Vector3f normal = octahedralDirection(static_cast<float>(column) * step - 1.0F,
                                                         static_cast<float>(row) * step - 1.0F);
      // Level ground of even brightness fills (1 − n_z) / 2 of what a surface sees.
      const Eigen::Array3f from_ground =
          table->ground_illuminance * (ground_albedo * 0.5F * (1.0F - normal.z()));
      table->illuminance[nodeIndex(row, column, kSide)] = gather(sky, normal) + padded(from_ground);
    }
  });
}

Eigen::Array3f SkyTable::skyLuminance(const Sight& sight) const {
  return weather ? weather->luminance(*this, sight) : clearLuminance(sight.towards);
}

Eigen::Array3f SkyTable::clearLuminance(const Eigen::Vector3f& towards) const {
  Eigen::Array3f sum = even;
  if (sun_sky) {
    sum += sun_sky->luminance(towards);
  }
  if (moon_sky) {
    sum += moon_sky->luminance(towards);
  }
  if (glow) {
    sum += glow->luminance(towards);
  }
  return sum;
}

Eigen::Array3f SkyTable::luminance(const Sight& sight) const {
  const Eigen::Vector3f& towards = sight.towards;
  const Eigen::Array3f above = skyLuminance(sight);
  if (towards.z() >= 0.0F) {
    return above;
  }
  // Ground seen from a hill of this height, or from where one is in fog, through haze that takes on the
  // colour of the horizon (Koschmieder 1924).
  constexpr float kHill_km = 0.1F;
  float eye_km = kHill_km, above_fog_km = 0.0F;
  Eigen::Array3f per_km = haze_per_km, below = above;
  const Fog fog = weather ? weather->fog(0.0F) : Fog();
  if (fog.per_m > 0.0F) {
    eye_km = std::max(kHill_km, 1e-3F * std::min(sight.height_m, fog.top_m));
    above_fog_km = 1e-3F * std::max(sight.height_m - fog.top_m, 0.0F);
    per_km += 1e3F * fog.per_m * std::min(1.0F, fog.top_m / (1e3F * eye_km));
    // What lies below an eye lies in the whole of the fog.
    if (sight.height_m > 0.0F) below = skyLuminance({towards, sight.from, 0.0F});
  }
  const float across = std::sqrt(towards.x() * towards.x() + towards.y() * towards.y());
  const Eigen::Array3f clear = (per_km * (-eye_km * across / -towards.z())).exp();
  const Eigen::Array3f seen = below * (1.0F - clear) + ground_luminance * clear;
  if (above_fog_km <= 0.0F) return seen;
  const Eigen::Array3f over = (haze_per_km * (-above_fog_km * across / -towards.z())).exp();
  return above * (1.0F - over) + seen * over;
}

AirColumn SkyTable::airOver(const Sight& sight, float distance_m) const {
  return weather ? weather->airOver(*this, sight, distance_m) : clearAir(sight.towards, distance_m);
}

AirColumn SkyTable::clearAir(const Eigen::Vector3f& towards, float distance_m) const {
  if (!sights) {
    return {Eigen::Array3f::Ones(), Eigen::Array3f::Zero()};
  }
  const AirSights::Place place = AirSights::placeOf(towards.z(), std::clamp(distance_m, 0.0F, 1e9F) * 1e-3F);
  const Eigen::Array4f passed = sights->transmittance(place);
  Eigen::Array4f light = Eigen::Array4f::Zero();
  if (sun_air) {
    light += sun_air->airlight(towards, place);
  }
  if (moon_air) {
    light += moon_air->airlight(towards, place);
  }
  AirColumn air{passed.head<3>(), light.head<3>()};
  if (glow) {
    // The glow lights the air from all sides alike: as much as it takes out, it puts in.
    air.airlight += glow->luminance(towards) * (1.0F - air.transmittance);
  }
  return air;
}

Eigen::Array3f SkyTable::illuminanceOn(const Eigen::Vector3f& normal) const {
  const Eigen::Vector2f place = (octahedralPlace(normal).array() + 1.0F) * (0.5F * (kNormals - 1));
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

}  // namespace sunlit::sky
