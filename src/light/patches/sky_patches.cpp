#include "light/patches/sky_patches.h"

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

using Ring = SkyPatches::Ring;
constexpr auto& kRings = SkyPatches::kRings;

constexpr double kGoldenRatioPart = 0.61803398874989485;

double middle(const Ring& ring) {
  return ring.patches == 1 ? 90.0 : 0.5 * (ring.low_deg + ring.high_deg);
}

double sine(double deg) {
  return std::sin(deg * kRadPerDeg);
}

/// Directions below the horizon, evenly spread along a Fibonacci spiral.
Eigen::Vector3f pointBelow(int i) {
  const double z = -(i + 0.5) / SkyPatches::kDown;
  const double azimuth = 2.0 * kPi * std::fmod(i * kGoldenRatioPart, 1.0);
  const double r = std::sqrt(1.0 - z * z);
  return Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), z).cast<float>();
}

/// Of a unit vector.
double elevationDeg(const Eigen::Vector3f& towards) {
  return std::asin(std::clamp<double>(towards.z(), -1.0, 1.0)) / kRadPerDeg;
}
/// Of its azimuth, 0 … 1.
double turnsOf(const Eigen::Vector3f& towards) {
  const double turns =
      std::atan2(static_cast<double>(towards.y()), static_cast<double>(towards.x())) / (2.0 * kPi);
  return turns < 0.0 ? turns + 1.0 : turns;
}

/// Divides `share` between the two patches of `ring` on both sides of an azimuth, given in turns.
void divide(const Ring& ring, double turns, double share, PatchShare* shares) {
  const double place = turns * ring.patches - 0.5;
  const double floor = std::floor(place);
  const int left = (static_cast<int>(floor) + ring.patches) % ring.patches;
  const double part = place - floor;
  shares[0] = {ring.first + left, static_cast<float>(share * (1.0 - part))};
  shares[1] = {ring.first + (left + 1) % ring.patches, static_cast<float>(share * part)};
}

}  // namespace

std::size_t SkyPatches::ringOf(int patch) {
  std::size_t ring = 0;
  while (patch >= kRings[ring].first + kRings[ring].patches) ++ring;
  return ring;
}

int SkyPatches::patchAt(const Eigen::Vector3f& towards) {
  if (!(towards.z() > 0.0f)) return kBelow;
  const double elevation_deg = elevationDeg(towards);
  const auto ring = std::find_if(kRings.begin(), kRings.end() - 1,
                                 [&](const Ring& candidate) { return elevation_deg < candidate.high_deg; });
  return ring->first + std::min(static_cast<int>(turnsOf(towards) * ring->patches), ring->patches - 1);
}

std::vector<int> SkyPatches::neighbours(int patch) {
  const std::size_t ring = ringOf(patch);
  const int count = kRings[ring].patches, place = patch - kRings[ring].first;
  std::vector<int> found;
  if (count > 1) {
    found.push_back(kRings[ring].first + (place + 1) % count);
    found.push_back(kRings[ring].first + (place + count - 1) % count);
  }
  for (const std::size_t other : {ring - 1, ring + 1}) {  // below ring 0 there is none either
    if (other >= kRings.size()) continue;
    const int others = kRings[other].patches;
    for (int i = 0; i < others; ++i) {
      if (place * others < (i + 1) * count && i * count < (place + 1) * others)
        found.push_back(kRings[other].first + i);
    }
  }
  return found;
}

Eigen::Vector3f SkyPatches::pointIn(int patch, double u, double v) {
  const Ring& ring = kRings[ringOf(patch)];
  const double z = sine(ring.low_deg) + v * (sine(ring.high_deg) - sine(ring.low_deg));
  const double azimuth = 2.0 * kPi * (patch - ring.first + u) / ring.patches;
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), z).cast<float>();
}

SkyPatches::SkyPatches(int rays_per_patch) {
  for (int patch = 0; patch < kAbove; ++patch) {
    const float part = solidAngle(patch) / static_cast<float>(rays_per_patch);
    for (int i = 0; i < rays_per_patch; ++i) {
      // A lattice, shifted from patch to patch so that no rows of directions line up.
      const double u = std::fmod((i + 0.5) * kGoldenRatioPart + patch * 0.3819660112501051, 1.0);
      const double v = (i + 0.5) / rays_per_patch;
      const bool coarse = i == rays_per_patch / 2;
      rays_.push_back({pointIn(patch, u, v), part, patch, coarse ? patch : Ray::kFineOnly});
      if (coarse) coarse_.push_back({rays_.back().towards, solidAngle(patch), patch, patch});
    }
  }
  for (int i = 0; i < kDown; ++i) {
    const Ray ray{pointBelow(i), static_cast<float>(2.0 * kPi / kDown), kBelow, kAbove + i};
    coarse_.push_back(ray);
    rays_.push_back(ray);
  }
}

float SkyPatches::solidAngle(int patch) {
  const Ring& ring = kRings[ringOf(patch)];
  return static_cast<float>(2.0 * kPi * (sine(ring.high_deg) - sine(ring.low_deg)) / ring.patches);
}

std::array<Eigen::Array3f, SkyPatches::kCount> SkyPatches::luminances(const sky::Daylight& day,
                                                                      Weight weight) {
  constexpr int kAcross = 4;  // points a patch and axis
  std::array<Eigen::Array3f, kCount> means;
  for (int patch = 0; patch < kAbove; ++patch) {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    float weights = 0.0f;
    for (int i = 0; i < kAcross * kAcross; ++i) {
      const double u = (i % kAcross + 0.5) / kAcross;
      const double v = (i / kAcross + 0.5) / kAcross;
      const Eigen::Vector3f towards = pointIn(patch, u, v);
      const float counts = weight == Weight::kCosine ? towards.z() : 1.0f;
      sum += counts * day.skyLuminance(towards).value;
      weights += counts;
    }
    means[static_cast<std::size_t>(patch)] = sum / weights;
  }
  Eigen::Array3f below = Eigen::Array3f::Zero();
  for (int i = 0; i < kDown; ++i) below += day.skyLuminance(pointBelow(i)).value;
  means[kBelow] = below / static_cast<float>(kDown);
  return means;
}

std::array<PatchShare, 4> SkyPatches::around(const Eigen::Vector3f& towards) {
  const double elevation = elevationDeg(towards), turns = turnsOf(towards);
  std::size_t low = 0;
  while (low + 2 < kRings.size() && middle(kRings[low + 1]) < elevation) ++low;
  const double from = middle(kRings[low]);
  const double to = middle(kRings[low + 1]);
  const double up = std::clamp((elevation - from) / (to - from), 0.0, 1.0);
  std::array<PatchShare, 4> shares;
  divide(kRings[low], turns, 1.0 - up, shares.data());
  divide(kRings[low + 1], turns, up, shares.data() + 2);
  return shares;
}

}  // namespace sunlit::light
