#include "sunlit/evaluate/features/draw.h"

#include <opencv2/features2d.hpp>

#include "sunlit/evaluate/picture.h"

namespace sunlit::evaluate {

cv::Mat drawMatches(const Detector* detector, const RatioTest& test, const cv::Mat& rgb_a,
                    const cv::Mat& rgb_b) {
  Features a;
  Features b;
  std::vector<cv::DMatch> accepted;
  if (detector != nullptr) {
    a = detectFeatures(*detector, makePicture(rgb_a).grey);
    b = detectFeatures(*detector, makePicture(rgb_b).grey);
    const std::vector<Neighbours> neighbours =
        twoNearestBothWays(a.descriptors, b.descriptors, detector->norm()).from_a;
    for (std::size_t query = 0; query < neighbours.size(); ++query) {
      const Neighbours& n = neighbours[query];
      if (passes(n, test)) accepted.emplace_back(static_cast<int>(query), n.best, n.best_distance);
    }
  }
  cv::Mat drawn;
  cv::drawMatches(rgb_a, a.key_points, rgb_b, b.key_points, accepted, drawn);
  return drawn;
}

}  // namespace sunlit::evaluate
