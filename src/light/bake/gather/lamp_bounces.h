/// Bakes what standing lamps, and surfaces that shine, give by way of surfaces.
#pragma once

#include "light/bake/gather/exchange.h"
#include "light/bake/samples/scene_samples.h"
#include "light/bake/samples/transport_data.h"
#include "light/bake/samples/work_done.h"
#include "light/lamps/lamp_beam.h"

namespace sunlit::light {

/// What shines by itself: what is baked, and the compact sources, whose light straight is that of pictures.
struct ShiningLights {
  const AreaLights &baked, &compact;
  const std::vector<LampBeam>& beams;  ///< of the compact ones

  bool any() const { return baked.any() || compact.any(); }
};

class LampBounces {
 public:
  /// By at most `bounces` from surface to surface. Keeps references.
  LampBounces(const BakeScene& scene, const SceneSamples& samples, const Exchange& exchange, int bounces)
      : scene_(scene), samples_(samples), exchange_(exchange), bounces_(bounces) {}

  /// Of each of the scene's lampSets(). Parallel; the same bits for any number of threads.
  BakedLamps bake(const Progress& progress) const;

  /// Sets PassedOn::glows of both parts: of what shines by way of surfaces, and of what is baked straight,
  /// too. Likewise.
  void bakeShining(const ShiningLights& shining, const Progress& progress, TransportData* data) const;

 private:
  /// What samples have straight from lamps, or from what shines, and the surfaces that these light brightly.
  struct Source {
    StraightLight lamps;
    std::vector<AreaLights::Piece> lit;
  };
  std::vector<std::vector<Arrived>> passedOn(std::vector<Source> sources, const Progress& progress) const;
  std::vector<Arrived> passedOn(Source source, const Progress& progress) const;
  bool looksAgain(const Source& source) const { return bounces_ > 1 && !source.lit.empty(); }
  Exchange::FirstBounce firstBounce(const Source& source, const Progress& progress) const;
  std::vector<Arrived> lookFor(const std::vector<AreaLights::Piece>& pieces, const Progress& progress) const;
  void addBounced(const std::vector<Arrived>& has, std::vector<AreaLights::Piece>* lit) const;
  /// Of surfaces that light, which of a triangle is looked for, and up to where.
  struct LookedFor {
    bool (*may)(const BakeScene& scene, std::uint32_t triangle);
    float farthest_m;
  };
  std::vector<bool> sending(const LookedFor& looked) const;
  /// Light straight of what shines: `arrived` too, unless null.
  StraightLight straight(const AreaLights& shining, const LookedFor& looked, const Progress& progress,
                         std::vector<Arrived>* arrived) const;

  const BakeScene& scene_;
  const SceneSamples& samples_;
  const Exchange& exchange_;
  int bounces_;
};

/// Adds `share` of the light of a set to what samples have: of BakedLamps::Light in lx, one a sample.
void addLamps(const BakedLamps& lamps, std::size_t set, float share, std::vector<BakedLamps::Light>* light);

}  // namespace sunlit::light
