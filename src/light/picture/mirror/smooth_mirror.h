/// What of the sky smooth surfaces mirror.
#pragma once

#include "light/picture/mirror/open_patches.h"

namespace sunlit::light {

/// Of a surface of such roughness that has `open` before it; `sheet`: light shines through it.
SmoothMirror smoothMirror(const Surface& surface, float roughness, bool sheet, const OpenPatches& open);

}  // namespace sunlit::light
