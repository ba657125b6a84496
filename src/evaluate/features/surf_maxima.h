// Key points: maxima of the determinant over position and scale (Bay et al. 2008, 3.4; Brown and Lowe 2002).
#pragma once

#include <vector>

#include "evaluate/features/surf_hessian.h"

namespace sunlit::evaluate::surf {

// Three neighbouring filter sizes of one octave; maxima are sought in the middle one.
struct LayerTriple {
  const HessianLayer* below;
  const HessianLayer* middle;
  const HessianLayer* above;
  int octave;
};

// What maxima are checked against. `mask_integral` may be empty: everything is allowed.
struct MaximaInput {
  const cv::Mat& integral;
  const cv::Mat& mask_integral;
  float threshold;
};

// Maxima of one triple in row order: position, size, response, octave and class_id are set.
std::vector<cv::KeyPoint> findMaxima(const LayerTriple& layers, const MaximaInput& input);

// Strongest first; a total order over all that distinguishes two key points, so that sorting has one outcome.
void sortByResponse(std::vector<cv::KeyPoint>& keypoints);

}  // namespace sunlit::evaluate::surf
