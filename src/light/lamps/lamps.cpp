#include "sunlit/light/lamps.h"

#include <algorithm>

namespace sunlit::light {
namespace {

/// Of the light at which lamps go off at dawn to that at which they go on at dusk.
constexpr double kSwitchingRatio = 1.5;

}  // namespace

void validate(const LampOptions& options) {
  requireFields(options);
}

bool burnUnder(const LampOptions& options, const sky::Daylight& day) {
  if (options.mode != LampMode::kAuto) return options.mode == LampMode::kOn;
  const bool rising = day.sun().towards.vector().x() > 0.0;
  const double limit_lx = rising ? kSwitchingRatio * options.dusk_lx : options.dusk_lx;
  return static_cast<double>(day.groundIlluminance().luminance()) < limit_lx;
}

std::vector<scene::Lamp> burning(const std::vector<scene::Lamp>& lamps, const LampOptions& options) {
  std::vector<scene::Lamp> kept;
  for (scene::Lamp lamp : lamps) {
    if (std::find(options.off.begin(), options.off.end(), lamp.group) != options.off.end()) continue;
    if (lamp.relative) lamp.intensity.value *= static_cast<float>(options.colour_lx);
    lamp.relative = false;
    if (lamp.intensity.value.maxCoeff() > 0.0f) kept.push_back(std::move(lamp));
  }
  return kept;
}

bool glows(const scene::Material& material, const std::vector<scene::Lamp>& burning) {
  if (!(material.emission.value.maxCoeff() > 0.0f)) return false;
  return material.lamp_group.empty() ||
         std::any_of(burning.begin(), burning.end(),
                     [&](const scene::Lamp& lamp) { return lamp.group == material.lamp_group; });
}

scene::Lamp placed(const scene::Lamp& lamp, const Eigen::Isometry3d& map_from_frame) {
  scene::Lamp moved = lamp;
  moved.position = (map_from_frame * lamp.position.cast<double>()).cast<float>();
  moved.direction = (map_from_frame.linear() * lamp.direction.cast<double>()).normalized().cast<float>();
  return moved;
}

}  // namespace sunlit::light
