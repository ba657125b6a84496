/// Bakes what standing lamps, and surfaces that shine, give by way of surfaces.
#pragma once

#include "light/bake/gather/exchange.h"
#include "light/bake/samples/scene_samples.h"
#include "light/bake/samples/transport_data.h"
#include "light/lamps/lamp_beam.h"

namespace sunlit::light {

/// What shines by itself: what is baked, and the compact sources, whose light straight is that of pictures.
struct ShiningLights {
  const AreaLights& baked;
  const std::vector<LampBeam>& compact;

  bool any() const { return baked.any() || !compact.empty(); }
};

class LampBounces {
 public:
  /// By at most `bounces` from surface to surface. Keeps references.
  LampBounces(const BakeScene& scene, const SceneSamples& samples, const Exchange& exchange, int bounces)
      : scene_(scene), samples_(samples), exchange_(exchange), bounces_(bounces) {}

  /// Of each of the scene's lampSets(). Parallel; the same bits for any number of threads.
  BakedLamps bake() const;

  /// Sets PassedOn::glows of both parts: of what shines by way of surfaces, and of what is baked straight,
  /// too. Likewise.
  void bakeShining(const ShiningLights& shining, TransportData* data) const;

 private:
  std::vector<Arrived> passedOn(const StraightLight& lamps, std::vector<AreaLights::Piece> lit) const;
  std::vector<Arrived> lookFor(const std::vector<AreaLights::Piece>& pieces) const;
  void addBounced(const std::vector<Arrived>& has, std::vector<AreaLights::Piece>* lit) const;
  std::vector<bool> sending() const;
  std::vector<Arrived> straightAndPassedOn(const AreaLights& shining) const;

  const BakeScene& scene_;
  const SceneSamples& samples_;
  const Exchange& exchange_;
  int bounces_;
};

/// Adds `share` of the light of a set to what samples have: of BakedLamps::Light in lx, one a sample.
void addLamps(const BakedLamps& lamps, std::size_t set, float share, std::vector<BakedLamps::Light>* light);

}  // namespace sunlit::light
