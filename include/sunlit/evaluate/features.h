/// Key points and descriptors, with OpenCV's own defaults.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

#include "sunlit/evaluate/difference.h"
#ifdef SUNLIT_SURF
#include "sunlit/evaluate/surf.h"
#endif

namespace sunlit::evaluate {

/// cv::SIFT. Defaults are OpenCV's.
struct SiftOptions {
  int n_features = 0;                ///< best features kept, ≥ 0; 0: all
  int n_octave_layers = 3;           ///< 1 … 10
  double contrast_threshold = 0.04;  ///< 0 … 1
  double edge_threshold = 10.0;      ///< > 0
  double sigma = 1.6;                ///< px, of the Gaussian of octave 0, 0.1 … 10
};

/// cv::ORB. Defaults are OpenCV's.
struct OrbOptions {
  int n_features = 500;       ///< ≥ 1
  double scale_factor = 1.2;  ///< between pyramid levels, 1.01 … 4
  int n_levels = 8;           ///< 1 … 32
  int edge_threshold = 31;    ///< px of border without key points, 1 … 200
  int first_level = 0;        ///< 0 … 31
  int wta_k = 2;  ///< points per element of the descriptor, 2 … 4; 3 and 4 are matched by NORM_HAMMING2
  int patch_size = 31;      ///< px, 2 … 200
  int fast_threshold = 20;  ///< grey levels, 1 … 255
};

/// cv::BRISK. Defaults are OpenCV's.
struct BriskOptions {
  int threshold = 30;          ///< of AGAST, grey levels, 1 … 255
  int n_octaves = 3;           ///< 0 … 9
  double pattern_scale = 1.0;  ///< 0.1 … 10
};

struct FeatureOptions {
  SiftOptions sift;
#ifdef SUNLIT_SURF
  SurfOptions surf;
#endif
  OrbOptions orb;
  BriskOptions brisk;
};

/// What one detector found in one picture. Descriptors are one row each: CV_32F for surf, CV_8U for the
/// others. (SIFT's elements are whole numbers up to 255 in OpenCV; as bytes they are the same numbers in a
/// quarter of the memory.)
struct Features {
  std::vector<cv::KeyPoint> key_points;
  cv::Mat descriptors;
};

/// The detector of a difference. Throws std::invalid_argument for a difference of pixels.
/// Not to be shared between threads: detectors keep buffers.
cv::Ptr<cv::Feature2D> makeDetector(Difference difference, const FeatureOptions& options);
/// How its descriptors are compared: a cv::NormTypes.
int normOf(Difference difference, const FeatureOptions& options);
/// Key points and descriptors of a grey picture. Deterministic to the bit, whatever the number of threads.
Features detectFeatures(Difference difference, const FeatureOptions& options, const cv::Mat& grey);

}  // namespace sunlit::evaluate
