#include "sunlit/evaluate/verify/draw_verified.h"

#include <opencv2/features2d.hpp>
#include <vector>

namespace sunlit::evaluate {

cv::Mat drawVerified(const ImagesToVerify& images, const FeaturePair& features,
                     const std::vector<AcceptedMatch>& accepted) {
  std::vector<cv::DMatch> right;
  std::vector<cv::DMatch> wrong;
  for (const AcceptedMatch& match : accepted) {
    (match.is_right ? right : wrong)
        .emplace_back(static_cast<int>(match.a), static_cast<int>(match.b), match.distance);
  }
  cv::Mat drawn;
  const auto draw = [&](const std::vector<cv::DMatch>& matches, const cv::Scalar& colour, int flags) {
    cv::drawMatches(images.rgb_a, features.a.key_points, images.rgb_b, features.b.key_points, matches, drawn,
                    colour, colour, std::vector<char>(), static_cast<cv::DrawMatchesFlags>(flags));
  };
  const int lines_only = static_cast<int>(cv::DrawMatchesFlags::NOT_DRAW_SINGLE_POINTS);
  draw(wrong, {230, 50, 40}, lines_only);
  draw(right, {40, 200, 70}, lines_only | static_cast<int>(cv::DrawMatchesFlags::DRAW_OVER_OUTIMG));
  return drawn;
}

}  // namespace sunlit::evaluate
