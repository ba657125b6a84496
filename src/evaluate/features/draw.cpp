#include "sunlit/evaluate/features/draw.h"

#include <algorithm>
#include <opencv2/features2d.hpp>

#include "sunlit/evaluate/differences/direct.h"

namespace sunlit::evaluate {

cv::Mat drawMatches(const ComparerOptions& options, const cv::Mat& rgb_a, const cv::Mat& rgb_b) {
  Features a;
  Features b;
  std::vector<cv::DMatch> accepted;
  const auto difference = std::find_if(options.differences.begin(), options.differences.end(), usesFeatures);
  if (difference != options.differences.end()) {
    a = detectFeatures(*difference, options.features, makePicture(rgb_a).grey);
    b = detectFeatures(*difference, options.features, makePicture(rgb_b).grey);
    const std::vector<Neighbours> neighbours =
        twoNearestBothWays(a.descriptors, b.descriptors, normOf(*difference, options.features)).from_a;
    for (std::size_t query = 0; query < neighbours.size(); ++query) {
      const Neighbours& n = neighbours[query];
      if (passes(n, options.ratio_test))
        accepted.emplace_back(static_cast<int>(query), n.best, n.best_distance);
    }
  }
  cv::Mat drawn;
  cv::drawMatches(rgb_a, a.key_points, rgb_b, b.key_points, accepted, drawn);
  return drawn;
}

}  // namespace sunlit::evaluate
