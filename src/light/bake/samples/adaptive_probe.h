/// Rays around points of the scene, finer where the open sky ends.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "light/bake/samples/probe.h"
#include "light/bake/samples/triangle_kinds.h"

namespace sunlit::light {

/// Most of the sky that a point sees is all open or all hidden, and there one ray of a patch tells as much as
/// several. All rays of a patch are cast only where its coarse ray tells otherwise than that of a patch
/// beside it, or meets a leaf, for gaps between leaves are finer than patches, and along the horizon. What is
/// open behind veils is told apart from what is open by whether they keep most of its light back.
class AdaptiveProbe {
 public:
  /// What a ray has met: the index of the receiver; that of the ray among SkyPatches::rays();
  /// Receiver::weight() times the solid angle that the ray stands for; and the hits, of which lane `receiver`
  /// is the receiver's.
  using Visit = std::function<void(int receiver, std::size_t ray, float weight, const HitLayers& hits)>;

  /// Keeps references.
  AdaptiveProbe(const BakeRays& scene, const std::vector<TriangleTraits>& traits, const SkyPatches& patches);

  /// Casts all coarse rays that count for a receiver, and others as said. The weights of a patch add up to
  /// what they would be with all of its rays. Sites whose coarse rays are enough cast no others, and each of
  /// these weighs as its direction does.
  void look(const ReceiverGroup& receivers, const Visit& visit) const;

 private:
  using Lanes = ReceiverGroup::Lanes;
  using Weights = std::array<float, RayPacket::kSize>;
  /// Rays of a patch, or one below the horizon.
  struct Part {
    std::size_t first, coarse, end;  ///< indices into SkyPatches::rays()
    std::vector<int> beside;         ///< other parts
    bool always;                     ///< all of its rays
  };
  /// What the coarse ray of a part met.
  struct CoarseHits {
    Lanes cast, open, leaf;
    Lanes dim;  ///< behind veils that keep most of the light back
    HitLayers hits;
  };
  using AllCoarseHits = std::array<CoarseHits, SkyPatches::kCoarse>;

  void castCoarse(const ReceiverGroup& receivers, AllCoarseHits* all) const;
  Lanes mixed(const AllCoarseHits& all, std::size_t part) const;
  void castOthers(const ReceiverGroup& receivers, std::size_t number, Lanes lanes, const Visit& visit) const;
  std::size_t turn(std::size_t number, std::size_t ray) const;
  Weights weights(const ReceiverGroup& receivers, const Part& part, Lanes fine) const;

  const BakeRays& scene_;
  const std::vector<TriangleTraits>& traits_;
  const std::vector<SkyPatches::Ray>& rays_;
  std::vector<Part> parts_;  ///< by coarse direction
};

}  // namespace sunlit::light
