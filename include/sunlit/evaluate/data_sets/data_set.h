/// Pictures with depth, calibration and truth, in the folders that other people's systems read.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sunlit/image/camera.h"
#include "sunlit/image/images.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// All text files are of one camera without distortion.
///
/// TUM RGB-D (J. Sturm et al., A benchmark for the evaluation of RGB-D SLAM systems, IROS 2012): rgb/ and
/// depth/ with rgb.txt, depth.txt, associations.txt; groundtruth.txt has map_from_optical.
///
/// EuRoC (M. Burri et al., The EuRoC micro aerial vehicle datasets, IJRR 35 (10), 2016): mav0/cam0 in grey,
/// as theirs; mav0/state_groundtruth_estimate0 has map_from_body, the body being the camera's link, and T_BS
/// of cam0 is body_from_optical. A stereo camera's right one is mav0/cam1, rectified. mav0/depth0 is not of
/// theirs: depth as TUM has it, of the same camera. timestamps.txt is the list that ORB-SLAM3 takes.
///
/// COLMAP 3.8: images/, and in sparse/0 a text model whose poses are known and which has no points yet:
/// optical_from_map, and a principal point 0.5 px to the right and down of ours, since its pixel (0, 0) is a
/// corner. depth/NAME.bin is a map as COLMAP has them, float, m, 0 where there is none.
/// queries_with_intrinsics.txt is the list that hloc takes of pictures to be localised.
///
/// TUM and EuRoC come with orb_slam.yaml, settings that ORB-SLAM2 and 3 both read.
enum class DataSetFormat { kTum, kEuroc, kColmap };

/// What people call them, in the order of DataSetFormat.
const std::vector<std::string>& dataSetFormatNames();

struct DataSetOptions {
  image::PinholeCamera camera;
  double rate_hz = 10.0;        ///< of its pictures, above 0
  double depth_scale = 5000.0;  ///< steps of 16-bit depth in a metre, above 0
  double baseline_m = 0.0;      ///< of EuRoC: to a right camera, like this one; 0: there is none
};

inline Field depthScaleRow(double* place) {
  return {
      "depth_scale",
      place,
      "1/m",
      {0.1, 1e6},
      "steps of 16-bit depth in a metre: TUM's has room up to 13.1 m, 500 up to 131 m; 0 is what has none"};
}

struct DataSetFrame {
  std::int64_t number = 0;  ///< ≥ 0, which increases
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();  ///< of its link: x forward, z up
};

/// How many pixels have a depth, and how many of them no place in the steps of the file.
struct DepthRoom {
  std::size_t seen = 0;
  std::size_t without_room = 0;
};

struct DataSetLayout;

/// One data set on disk, written picture by picture over any number of runs. Every file is whole or not
/// there. All functions throw std::runtime_error naming the file that cannot be made or written.
class DataSetFolder {
 public:
  /// Makes nothing. Throws std::invalid_argument for options out of range.
  DataSetFolder(const std::string& folder, DataSetFormat format, const DataSetOptions& options);

  /// Whether pictures and depth are there, whole, and of the camera's size.
  bool has(const DataSetFrame& frame) const;
  /// Both of the camera's size, or std::invalid_argument.
  DepthRoom write(const DataSetFrame& frame, const image::Rgb8Image& picture,
                  const image::DepthImage& depth) const;
  /// Whether there is a place for what a right camera sees: in EuRoC's form, with a baseline.
  bool hasRight() const;
  /// Where hasRight(). As write().
  void writeRight(const DataSetFrame& frame, const image::Rgb8Image& picture) const;
  /// Calibration, truth and lists of all `frames`, by number and stamp: last, so that a folder that has them
  /// has all.
  void finish(const std::vector<DataSetFrame>& frames) const;

 private:
  std::string pictureFile(const std::string& of_layout, const DataSetFrame& frame) const;
  void writePicture(const std::string& file, const image::Rgb8Image& picture) const;
  std::string depthFile(const DataSetFrame& frame) const;
  DepthRoom writeDepth(const std::string& file, const image::DepthImage& depth) const;

  std::string folder_;
  const DataSetLayout& layout_;
  DataSetOptions options_;
};

}  // namespace sunlit::evaluate
