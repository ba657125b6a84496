/// One vector a picture, made of all its local features: vectors of locally aggregated descriptors (H. Jégou,
/// M. Douze, C. Schmid, P. Pérez, CVPR 2010), intra-normalised (R. Arandjelović, A. Zisserman, "All about
/// VLAD", CVPR 2013, section 3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/detector.h"
#include "sunlit/evaluate/places/place_scores.h"

namespace sunlit::evaluate {

constexpr int kVisualWords = 64;  // k
/// Of a larger map, so many descriptors, evenly spread, train its words: some 800 a word.
constexpr std::size_t kMostTrainingDescriptors = 50000;
constexpr std::uint64_t kVocabularySeed = 20121;  // any: what counts is that it is always the same
constexpr int kMostRounds = 50;                   // of k-means; it ends sooner where nothing changes

/// Descriptors of a detector's `space` as points between which Euclidean distances mean something,
/// CV_32FC1, one row each:
/// - of histograms, SIFT's, their RootSIFT, as the detector `rootsift` has it;
/// - of descriptors compared by a Hamming norm (cv::NormTypes) their bits, 0 or 1, lowest first: squared
///   distances are Hamming distances then, and the mean of points, a word, is how often each bit is set;
/// - of others, such as SURF, their numbers.
cv::Mat vladPoints(const DescriptorSpace& space, const cv::Mat& descriptors);

/// Every n-th of all descriptors, in the order of their pictures, so that kMostTrainingDescriptors are left.
/// As floats where some pictures have bytes and others floats.
cv::Mat vladTrainingDescriptors(const std::vector<cv::Mat>& by_picture);

/// The words, CV_32FC1, one row each: k-means (Lloyd) from k-means++ beginnings (Arthur & Vassilvitskii
/// 2007), at most kMostRounds rounds. A point belongs to the nearest word, of equally near ones to the first;
/// a word without points stays where it is. The same bits for any number of threads and from run to run.
/// Throws std::invalid_argument where there are fewer than `words` different points.
cv::Mat trainVocabulary(const cv::Mat& points, int words, std::uint64_t seed);

/// For each word the sum of what its points are off it, brought to length 1; all of them together brought to
/// length 1: CV_32FC1, one row of words.rows · words.cols numbers. All 0 where there are no points, or none
/// is off its word.
cv::Mat vladOf(const cv::Mat& points, const cv::Mat& words);

/// Euclidean distances of vectors of vladOf(), 0 … 2. One that is all 0 knows nothing: its distances are
/// infinite, so that a query finds nothing and a place is never found. Runs in parallel, to the same bits.
PlaceMatrix vladDistances(const std::vector<cv::Mat>& queries, const std::vector<cv::Mat>& map);

}  // namespace sunlit::evaluate
