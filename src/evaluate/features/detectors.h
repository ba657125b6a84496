/// The detectors that are built in, each with OpenCV's parameters and defaults, in a file of its own.
#pragma once

#include <memory>

#include "sunlit/evaluate/features/detector.h"

namespace sunlit::evaluate {

/// More features are a mistake, and would fill the memory.
constexpr double kMostFeatures = 1e6;

/// What keeps edges sharp while KAZE and AKAZE blur, in the order of cv::KAZE::DiffusivityType.
inline const std::vector<std::string> kDiffusivities = {"pm_g1", "pm_g2", "weickert", "charbonnier"};
constexpr const char* kDiffusivityDoc =
    "of the blur: Perona and Malik's first or second, Weickert's, Charbonnier's";

#ifdef SUNLIT_SIFT
std::unique_ptr<Detector> makeSift();
/// SIFT with the descriptors of rootSift().
std::unique_ptr<Detector> makeRootSift();
#endif
#ifdef SUNLIT_SURF
std::unique_ptr<Detector> makeSurf();
#endif
std::unique_ptr<Detector> makeOrb();
std::unique_ptr<Detector> makeBrisk();
std::unique_ptr<Detector> makeAkaze();
std::unique_ptr<Detector> makeKaze();
std::unique_ptr<Detector> makeOnnx();

}  // namespace sunlit::evaluate
