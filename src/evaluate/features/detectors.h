/// The detectors that are built in, each with OpenCV's parameters and defaults, in a file of its own.
#pragma once

#include <memory>

#include "sunlit/evaluate/features/detector.h"

namespace sunlit::evaluate {

/// More features are a mistake, and would fill the memory.
constexpr double kMostFeatures = 1e6;

std::unique_ptr<Detector> makeSift();
#ifdef SUNLIT_SURF
std::unique_ptr<Detector> makeSurf();
#endif
std::unique_ptr<Detector> makeOrb();
std::unique_ptr<Detector> makeBrisk();

}  // namespace sunlit::evaluate
