/// A picture of which matches are right, to look at.
#pragma once

#include <opencv2/core/mat.hpp>

#include "sunlit/evaluate/verify/verify.h"

namespace sunlit::evaluate {

/// Both images side by side with the accepted matches: wrong ones red, and right ones (as for the precision)
/// green above them. Images and result are CV_8UC3, red first.
cv::Mat drawVerified(const ImagesToVerify& images, const FeaturePair& features, const PointMaps& maps,
                     const RatioTest& test);

}  // namespace sunlit::evaluate
