/// What one format of data sets has where.
#pragma once

#include <string>
#include <vector>

#include "sunlit/evaluate/data_sets/data_set.h"

namespace sunlit::evaluate {

struct TextFile {
  std::string path;  ///< within the folder
  std::string text;
};

struct DataSetLayout {
  std::string picture_folder, depth_folder;  ///< within the folder, with a slash at the end
  std::string right_folder;                  ///< likewise, of the right camera; empty: it knows one alone
  /// Of both, without what tells the kind of file.
  std::string (*name)(const DataSetFrame& frame);
  bool is_grey = false;
  bool has_float_depth = false;  ///< COLMAP's, not PNG
  std::vector<TextFile> (*texts)(const DataSetOptions& options, const std::vector<DataSetFrame>& frames);
};

const DataSetLayout& tumLayout();
const DataSetLayout& eurocLayout();
const DataSetLayout& colmapLayout();

/// Digits of lengths, m, and of components of quaternions: no pose is told worse than to 1e-9.
constexpr int kPoseDigits = 9;
constexpr int kQuaternionDigits = 12;

/// With so many digits after the point, so that any reader takes it for a real number.
std::string fixedText(double number, int digits = kPoseDigits);
/// All, with what stands between them.
std::string fixedTexts(const std::vector<double>& numbers, const std::string& between,
                       int digits = kPoseDigits);

/// Of two that turn alike, the one with w ≥ 0.
Eigen::Quaterniond turnOf(const Eigen::Isometry3d& pose);

/// orb_slam.yaml.
TextFile orbSlamSettings(const DataSetOptions& options);

}  // namespace sunlit::evaluate
