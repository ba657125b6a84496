#include "sunlit/evaluate/differences/difference.h"

#include <algorithm>
#include <array>

namespace sunlit::evaluate {
namespace {

const std::array<std::string, 8> kNames = {"boolean_rgb", "boolean_grey", "euclidean_rgb", "euclidean_grey",
                                           "sift",        "surf",         "orb",           "brisk"};

}  // namespace

const std::vector<Difference>& allDifferences() {
  static const std::vector<Difference> all = {Difference::kBooleanRgb,   Difference::kBooleanGrey,
                                              Difference::kEuclideanRgb, Difference::kEuclideanGrey,
                                              Difference::kSift,
#ifdef SUNLIT_SURF
                                              Difference::kSurf,
#endif
                                              Difference::kOrb,          Difference::kBrisk};
  return all;
}

const std::string& nameOf(Difference difference) {
  return kNames.at(static_cast<std::size_t>(difference));
}

Choices someOf(std::vector<Difference>* differences) {
  const auto namesOf = [](const std::vector<Difference>& some) {
    std::vector<std::string> names;
    for (const Difference difference : some) names.push_back(nameOf(difference));
    return names;
  };
  return {namesOf(allDifferences()), [=] { return namesOf(*differences); },
          [=](const std::vector<std::string>& names) {
            differences->clear();
            for (const std::string& name : names) {
              const auto found = std::find(kNames.begin(), kNames.end(), name);
              differences->push_back(static_cast<Difference>(found - kNames.begin()));
            }
          }};
}

bool usesFeatures(Difference difference) {
  return difference >= Difference::kSift;
}

}  // namespace sunlit::evaluate
