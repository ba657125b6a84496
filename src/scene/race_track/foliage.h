/// Painted leaves, needles and blades, cut out of their pictures.
#pragma once

#include <array>

#include "scene/race_track/assembly.h"

namespace sunlit::scene::race_track {

enum class Species { kOak, kBirch, kMaple, kLime, kCopperBeech, kSpruce, kPine };
constexpr int kSpeciesCount = 7;
constexpr int kVariants = 2;
constexpr int kTufts = 8;

struct Foliage {
  std::array<std::array<Picture, kVariants>, kSpeciesCount> leaves;
  std::array<Picture, kTufts> tufts;
};

Foliage paintFoliage(Assembly& assembly);

}  // namespace sunlit::scene::race_track
