/// π as the shapes of the race track need it.
#pragma once

#include "sunlit/quantity/angle.h"

namespace sunlit::scene {

constexpr float kPiFloat = static_cast<float>(kPi);

}  // namespace sunlit::scene
