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

/// Words in an order in which several are compared at once. Each distance is summed up in the order of its
/// coordinates, whatever the machine.
class WordSearch {
 public:
  /// `words` is CV_32FC1, one row each, not empty.
  explicit WordSearch(const cv::Mat& words);
  /// Of a point of as many coordinates.
  NearestWord nearest(const float* point) const;
  /// Of all rows of a CV_32FC1 matrix, in parallel.
  std::vector<NearestWord> nearest(const cv::Mat& points) const;

 private:
  int words_;
  std::size_t coordinates_;
  std::vector<float> table_;  // blocks of words; in a block, coordinate by coordinate, those of all its words
};

}  // namespace sunlit::evaluate
