/// What a bake depends on.
#pragma once

#include <cstdint>
#include <vector>

#include "sunlit/image/content_hash.h"
#include "sunlit/light/geometry.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {

/// Goes up whenever the bake, scene::Weathering or the layout of the file changes.
constexpr std::uint32_t kBakeVersion = 46;

/// Shape, and of the looks what decides how light goes on from it.
void addContents(const Geometry& geometry, image::ContentHash* hash);

/// All that decides what they give.
void addLamps(const std::vector<scene::Lamp>& lamps, image::ContentHash* hash);

/// Of everything that a bake depends on.
image::ContentHash bakeKey(const Geometry& geometry, const TransportOptions& options);

}  // namespace sunlit::light
