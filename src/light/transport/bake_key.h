/// What a bake depends on.
#pragma once

#include <cstdint>

#include "sunlit/light/geometry.h"
#include "sunlit/light/transport.h"
#include "sunlit/scene/content_hash.h"

namespace sunlit::light {

/// Goes up whenever the bake or the layout of its file changes.
constexpr std::uint32_t kBakeVersion = 15;

/// Shape, and of the looks what decides how light goes on from it.
void addContents(const Geometry& geometry, scene::ContentHash* hash);

/// Of everything that a bake depends on.
scene::ContentHash bakeKey(const Geometry& geometry, const TransportOptions& options);

}  // namespace sunlit::light
