#include "evaluate/features/root_sift.h"

#include <cmath>
#include <numeric>

namespace sunlit::evaluate {

cv::Mat rootSift(const cv::Mat& descriptors) {
  cv::Mat roots;
  descriptors.convertTo(roots, CV_32F);
  for (int i = 0; i < roots.rows; ++i) {
    float* const row = roots.ptr<float>(i);
    const float sum = std::accumulate(row, row + roots.cols, 0.0F);  // of whole numbers: exact
    for (int k = 0; k < roots.cols && sum > 0.0F; ++k) row[k] = std::sqrt(row[k] / sum);
  }
  return roots;
}

}  // namespace sunlit::evaluate
