/// Speeded-Up Robust Features as a cv::Feature2D, for the OpenCV packages that ship without them.
///
/// Model: H. Bay, A. Ess, T. Tuytelaars, L. Van Gool, "Speeded-Up Robust Features (SURF)", CVIU 110(3), 2008,
/// in the variant that OpenCV defines, so that results compare with published ones.
#pragma once

#include <opencv2/features2d.hpp>
#include <vector>

#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// Defaults are those of OpenCV's cv::xfeatures2d::SURF.
struct SurfOptions {
  double hessian_threshold = 100;
  int octaves = 4;
  int octave_layers = 3;
  bool extended = false;
  bool upright = false;  ///< every angle is 270 degrees
};

inline std::vector<Field> fieldsOf(SurfOptions& surf) {
  return {{"hessian_threshold",
           &surf.hessian_threshold,
           "",
           {0, 1e6},
           "that the determinant of the Hessian exceeds, grey levels squared"},
          {"n_octaves", &surf.octaves, "", {1, 8}, "doublings of the sampling step"},
          {"n_octave_layers", &surf.octave_layers, "", {1, 16}, "filter sizes of an octave"},
          {"extended", &surf.extended, "", {}, "128 numbers a descriptor instead of 64"},
          {"upright", &surf.upright, "", {}, "no orientation"}};
}

/// A detector and descriptor that keeps to OpenCV's conventions.
///
/// - Images are 8-bit with 1, 3 (BGR) or 4 (BGRA) channels and not empty; colour is turned to grey by
///   cv::cvtColor. Anything else, a mask of another type or size, or given key points without wanted
///   descriptors raise cv::Exception.
/// - A mask is CV_8U of the image's size: key points lie where it is not 0, and at least half of their
///   filter's square is not 0.
/// - Key points come strongest first. `pt` in px (the centre of the top left pixel is 0, 0); `size` = side of
///   the filter in px, a whole number (the scale is size * 1.2 / 9); `response` = determinant of the Hessian;
///   `octave` from 0; `class_id` = sign of the Laplacian (1: dark blob, -1: bright blob); `angle` in degrees,
///   [0, 360), with x to the right and y down. Points without an angle, since no gradient filter fits into
///   the image there, are removed.
/// - Descriptors are CV_32F rows of length 1 (all 0 where the image is flat), compared by cv::NORM_L2.
/// - Images too small for any filter give no key points and are no error.
///
/// Against OpenCV's own on real pictures: the same number of key points, positions within 0.002 px, angles
/// within 0.1 degrees, descriptors within 0.05 (0.003 for 99 of 100), since grey levels are rounded on the
/// way.
///
/// The result depends on input and options only: it is the same to the bit for any number of threads (work is
/// shared out by TBB, so a caller limits it by tbb::global_control or a tbb::task_arena) and with or without
/// vector units. There is no state between calls, which may run at the same time.
///
/// Throws std::invalid_argument naming the option, its value and its range.
cv::Ptr<cv::Feature2D> createSurf(const SurfOptions& options = SurfOptions());

}  // namespace sunlit::evaluate
