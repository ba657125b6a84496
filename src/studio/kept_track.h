/// The built-in world on disk: to make it takes seconds, most of them to paint its textures.
#pragma once

#include <filesystem>
#include <functional>

#include "sunlit/scene/race_track.h"
#include "sunlit/scene/shape.h"
#include "sunlit/studio/reports.h"

namespace sunlit::studio {

/// scene::raceTrack(), flattened, to the bit, kept in `folder` as image::CacheFolder has it and taken from
/// there by those that run the same build. What is damaged is made anew. Warns where it cannot be kept.
/// `make`: what makes it, for tests.
scene::FlatScene keptRaceTrack(const std::filesystem::path& folder, const Reports& reports,
                               const std::function<scene::Scene()>& make = scene::raceTrack);

}  // namespace sunlit::studio
