#include "light/lamps/beams_of_light.h"

namespace sunlit::light {

std::vector<LampBeam> beamsOf(const Illumination& light) {
  std::vector<LampBeam> beams;
  const auto add = [&](const auto& lights) {
    if (!lights) return;
    for (const auto& one : *lights) beams.emplace_back(one);
  };
  add(light.lamps);
  add(light.bounced);
  add(light.compact_sources);
  return beams;
}

}  // namespace sunlit::light
