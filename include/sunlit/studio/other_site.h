/// Whether the sun is seen from where the world's file says that it lies.
#pragma once

#include <string>

#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/site.h"
#include "sunlit/scene/world_site.h"
#include "sunlit/studio/sky.h"

namespace sunlit::studio {

/// Whether `site` is that of the world but for rounding: 0.02° and 100 m.
bool isSiteOf(const scene::WorldSite& world, const Site& site);

/// The same of what is in the sky at that instant, by the turn of the stars or, where there are none, by the
/// sun.
bool isSkyOver(const scene::WorldSite& world, const SkyBodies& bodies, const Instant& instant);

/// A warning that it is not, and what to type.
std::string otherSiteText(const scene::WorldSite& world);

}  // namespace sunlit::studio
