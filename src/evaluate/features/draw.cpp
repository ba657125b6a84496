#include "sunlit/evaluate/features/draw.h"

#include <opencv2/features2d.hpp>

#include "sunlit/evaluate/picture.h"

namespace sunlit::evaluate {

cv::Mat drawMatches(const Detector* detector, const RatioTest& test, const std::array<cv::Mat, 2>& rgb,
                    const StopToken& stop) {
  Features a;
  Features b;
  std::vector<cv::DMatch> accepted;
  if (detector != nullptr) {
    stop.check();
    a = detectFeatures(*detector, makePicture(rgb[0]));
    stop.check();
    b = detectFeatures(*detector, makePicture(rgb[1]));
    const std::vector<Neighbours> neighbours =
        twoNearestBothWays(a.descriptors, b.descriptors, detector->norm(), stop).from_a;
    for (std::size_t query = 0; query < neighbours.size(); ++query) {
      const Neighbours& n = neighbours[query];
      if (passes(n, test)) accepted.emplace_back(static_cast<int>(query), n.best, n.best_distance);
    }
  }
  cv::Mat drawn;
  cv::drawMatches(rgb[0], a.key_points, rgb[1], b.key_points, accepted, drawn);
  return drawn;
}

}  // namespace sunlit::evaluate
