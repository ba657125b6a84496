// By USAC, which OpenCV has from 4.5 on.
#include <opencv2/calib3d.hpp>

#include "evaluate/localise/pose_search.h"

namespace sunlit::evaluate {

bool searchPose(const PoseOptions& options, PoseSearch* search) {
  cv::UsacParams usac;
  usac.confidence = options.confidence;
  usac.isParallel = false;
  usac.maxIterations = options.iterations;
  usac.randomGeneratorState = options.seed;
  usac.sampler = cv::SAMPLING_UNIFORM;
  usac.score = cv::SCORE_METHOD_MSAC;
  usac.loMethod = cv::LOCAL_OPTIM_INNER_LO;
  usac.threshold = options.reprojection_px;
  cv::Mat inliers;
  cv::Mat matrix = search->matrix.clone();
  return cv::solvePnPRansac(search->points, search->pixels, matrix, cv::noArray(), search->rotation,
                            search->translation, inliers, usac);
}

}  // namespace sunlit::evaluate
