/// Key points and descriptors, with OpenCV's own defaults.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

#include "sunlit/evaluate/differences/difference.h"
#include "sunlit/quantity/field.h"
#ifdef SUNLIT_SURF
#include "sunlit/evaluate/features/surf.h"
#endif

namespace sunlit::evaluate {

/// More are a mistake, and would fill the memory.
constexpr double kMostFeatures = 1e6;

/// cv::SIFT. Defaults are OpenCV's.
struct SiftOptions {
  int n_features = 0;
  int n_octave_layers = 3;
  double contrast_threshold = 0.04;
  double edge_threshold = 10.0;
  double sigma = 1.6;
};

inline std::vector<Field> fieldsOf(SiftOptions& sift) {
  return {{"n_features", &sift.n_features, "", {0, kMostFeatures}, "best ones kept; 0: all"},
          {"n_octave_layers", &sift.n_octave_layers, "", {1, 10}, "layers of an octave"},
          {"contrast_threshold", &sift.contrast_threshold, "", {0, 1}, "weaker ones are left out"},
          {"edge_threshold", &sift.edge_threshold, "", {1e-3, 1e6}, "more edge-like ones are left out"},
          {"sigma", &sift.sigma, "px", {0.1, 10}, "of the Gaussian of octave 0"}};
}

/// cv::ORB. Defaults are OpenCV's.
struct OrbOptions {
  int n_features = 500;
  double scale_factor = 1.2;
  int n_levels = 8;
  int edge_threshold = 31;
  int first_level = 0;
  int wta_k = 2;  ///< 3 and 4 are matched by NORM_HAMMING2
  int patch_size = 31;
  int fast_threshold = 20;
};

inline std::vector<Field> fieldsOf(OrbOptions& orb) {
  return {{"n_features", &orb.n_features, "", {1, kMostFeatures}, "best ones kept"},
          {"scale_factor", &orb.scale_factor, "", {1.01, 4}, "between pyramid levels"},
          {"n_levels", &orb.n_levels, "", {1, 32}, "of the pyramid"},
          {"edge_threshold", &orb.edge_threshold, "px", {1, 200}, "of border without key points"},
          {"first_level", &orb.first_level, "", {0, 31}, "of the pyramid that the image is put into"},
          {"wta_k", &orb.wta_k, "", {2, 4}, "points per element of the descriptor"},
          {"patch_size", &orb.patch_size, "px", {2, 200}, "of a descriptor"},
          {"fast_threshold", &orb.fast_threshold, "grey levels", {1, 255}, "of FAST"}};
}

/// cv::BRISK. Defaults are OpenCV's.
struct BriskOptions {
  int threshold = 30;
  int n_octaves = 3;
  double pattern_scale = 1.0;
};

inline std::vector<Field> fieldsOf(BriskOptions& brisk) {
  return {{"threshold", &brisk.threshold, "grey levels", {1, 255}, "of AGAST"},
          {"n_octaves", &brisk.n_octaves, "", {0, 9}, "0: one scale"},
          {"pattern_scale", &brisk.pattern_scale, "", {0.1, 10}, "of the descriptor's pattern"}};
}

struct FeatureOptions {
  SiftOptions sift;
#ifdef SUNLIT_SURF
  SurfOptions surf;
#endif
  OrbOptions orb;
  BriskOptions brisk;
};

inline std::vector<Field> fieldsOf(FeatureOptions& features) {
  return joined({under("sift", fieldsOf(features.sift)),
#ifdef SUNLIT_SURF
                 under("surf", fieldsOf(features.surf)),
#endif
                 under("orb", fieldsOf(features.orb)), under("brisk", fieldsOf(features.brisk))});
}

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
