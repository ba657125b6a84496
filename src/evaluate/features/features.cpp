#include "sunlit/evaluate/features/features.h"

#include <stdexcept>

namespace sunlit::evaluate {

cv::Ptr<cv::Feature2D> makeDetector(Difference difference, const FeatureOptions& options) {
  switch (difference) {
    case Difference::kSift: {
      const SiftOptions& o = options.sift;
      return cv::SIFT::create(o.n_features, o.n_octave_layers, o.contrast_threshold, o.edge_threshold,
                              o.sigma, CV_8U);
    }
#ifdef SUNLIT_SURF
    case Difference::kSurf:
      return createSurf(options.surf);
#endif
    case Difference::kOrb: {
      const OrbOptions& o = options.orb;
      return cv::ORB::create(o.n_features, static_cast<float>(o.scale_factor), o.n_levels, o.edge_threshold,
                             o.first_level, o.wta_k, cv::ORB::HARRIS_SCORE, o.patch_size, o.fast_threshold);
    }
    case Difference::kBrisk: {
      const BriskOptions& o = options.brisk;
      return cv::BRISK::create(o.threshold, o.n_octaves, static_cast<float>(o.pattern_scale));
    }
    default:
      throw std::invalid_argument("difference " + nameOf(difference) + " has no features");
  }
}

int normOf(Difference difference, const FeatureOptions& options) {
  switch (difference) {
    case Difference::kOrb:
      return options.orb.wta_k == 2 ? cv::NORM_HAMMING : cv::NORM_HAMMING2;
    case Difference::kBrisk:
      return cv::NORM_HAMMING;
    default:
      return cv::NORM_L2;
  }
}

Features detectFeatures(Difference difference, const FeatureOptions& options, const cv::Mat& grey) {
  Features features;
  makeDetector(difference, options)
      ->detectAndCompute(grey, cv::noArray(), features.key_points, features.descriptors);
  return features;
}

}  // namespace sunlit::evaluate
