/// A picture of which matches are right, to look at.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "sunlit/evaluate/verify/verify.h"

namespace sunlit::evaluate {

/// Both images side by side with the accepted matches, see acceptedMatches(): wrong ones red, and right ones
/// (as for the precision) green above them. Images and result are CV_8UC3, red first.
cv::Mat drawVerified(const ImagesToVerify& images, const FeaturePair& features,
                     const std::vector<AcceptedMatch>& accepted);

}  // namespace sunlit::evaluate
