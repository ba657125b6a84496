/// The nearest of a few points: the inner loop of k-means and VLAD.
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace sunlit::evaluate {

struct NearestWord {
  int word = 0;           ///< the first of equally near ones
  float distance2 = 0.0;  ///< squared
};

/// Words in an order in which all are compared at once. Each distance is summed up in the order of its
/// coordinates, whatever the machine.
class WordSearch {
 public:
  /// `words` is CV_32FC1, one row each, not empty.
  explicit WordSearch(const cv::Mat& words);
  /// Of all rows of a CV_32FC1 matrix, in parallel.
  std::vector<NearestWord> nearest(const cv::Mat& points) const;

 private:
  NearestWord nearest(const float* point, std::vector<float>* distances2) const;

  std::size_t words_;
  std::size_t coordinates_;
  std::size_t width_;         // words, filled up
  std::vector<float> table_;  // coordinate by coordinate, those of all words side by side
};

}  // namespace sunlit::evaluate
