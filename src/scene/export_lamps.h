/// Lamps in the words of KHR_lights_punctual.
#pragma once

#include <string>

#include "scene/export_losses.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// The entry of `lamp` in "lights", in cd. What falls off otherwise than with the square of the distance is
/// given the intensity that lights a place as far away as z = 0 lies below it (1 … 20 m, and no more than
/// half its range) as before; that, and whatever else the extension has no word for, is added to `losses`.
std::string lightJson(const Lamp& lamp, ExportLosses* losses);

/// The node of `lamp`, which is number `index` in "lights".
std::string lampNodeJson(const Lamp& lamp, std::size_t index);

}  // namespace sunlit::scene
