/// Surfaces close to lamps, or to what shines by itself, so bright that they light others as lamps do: see
/// lookedFor().
#pragma once

#include <vector>

#include "light/bake/samples/area_lights.h"
#include "light/bake/samples/triangle_kinds.h"
#include "light/lamps/lamp_beam.h"

namespace sunlit::light {

/// Whether lamp light that a triangle passes on may be looked for: it is opaque, and no leaf.
bool maySendLampLight(const BakeScene& scene, std::uint32_t triangle);
/// The same of light of what shines: of small things, such as a housing around it, and not of what shines
/// itself, of which what it reflects counts little.
bool maySendShine(const BakeScene& scene, std::uint32_t triangle);

/// What surfaces pass on of the light that they have straight from `lamps`, as far as it is looked for.
/// Parallel; the same for any number of threads.
std::vector<AreaLights::Piece> litPieces(const BakeScene& scene, const std::vector<LampBeam>& lamps);
/// The same of what shines.
std::vector<AreaLights::Piece> litPieces(const BakeScene& scene, const AreaLights& shining);

}  // namespace sunlit::light
