#include "light/lamps/lamp_sets.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace sunlit::light {

std::vector<LampSet> lampSets(const std::vector<scene::Lamp>& lamps) {
  std::vector<LampSet> sets;
  std::map<std::pair<std::string, bool>, std::size_t> number;
  for (std::uint32_t i = 0; i < lamps.size(); ++i) {
    const auto [known, is_new] = number.emplace(std::pair(lamps[i].group, lamps[i].relative),
                                                std::min(number.size(), kMostLampSets - 1));
    if (is_new && known->second == sets.size()) sets.emplace_back();
    sets[known->second].lamps.push_back(i);
  }
  return sets;
}

std::vector<scene::Lamp> lampsOf(const LampSet& set, const std::vector<scene::Lamp>& lamps,
                                 const LampOptions& options) {
  std::vector<scene::Lamp> members;
  for (const std::uint32_t i : set.lamps) members.push_back(lamps[i]);
  return burning(members, options);
}

std::vector<float> burningShares(const std::vector<scene::Lamp>& lamps, const LampOptions& options) {
  const auto sum = [](const std::vector<scene::Lamp>& some) {
    float luminances = 0.0f;
    for (const scene::Lamp& lamp : some) luminances += lamp.intensity.luminance();
    return luminances;
  };
  std::vector<float> shares;
  for (const LampSet& set : lampSets(lamps)) {
    const float all = sum(lampsOf(set, lamps));
    shares.push_back(all > 0.0f ? sum(lampsOf(set, lamps, options)) / all : 0.0f);
  }
  return shares;
}

}  // namespace sunlit::light
