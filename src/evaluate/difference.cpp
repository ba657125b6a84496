#include "sunlit/evaluate/difference.h"

#include <array>
#include <stdexcept>

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

Difference differenceNamed(const std::string& name) {
  std::string allowed;
  for (const Difference difference : allDifferences()) {
    if (nameOf(difference) == name) return difference;
    allowed += (allowed.empty() ? "" : ", ") + nameOf(difference);
  }
  if (name == nameOf(Difference::kSurf)) {
    throw std::invalid_argument(
        "difference surf: this build has none (option SUNLIT_SURF is off); allowed: " + allowed);
  }
  throw std::invalid_argument("difference \"" + name + "\" is unknown; allowed: " + allowed);
}

bool usesFeatures(Difference difference) {
  return difference >= Difference::kSift;
}

}  // namespace sunlit::evaluate
