#include "sunlit/evaluate/data_sets/data_set.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <system_error>

#include "evaluate/data_sets/layout.h"
#include "sunlit/image/files.h"
#include "sunlit/image/stereo.h"

namespace sunlit::evaluate {
namespace {

namespace fs = std::filesystem;

const DataSetLayout& layoutOf(DataSetFormat format) {
  if (format == DataSetFormat::kTum) return tumLayout();
  return format == DataSetFormat::kEuroc ? eurocLayout() : colmapLayout();
}

void makeFolderOf(const std::string& file) {
  image::makeFolder(fs::path(file).parent_path().string());
}

image::Grey8Image greyOf(const image::Rgb8Image& picture) {
  image::Grey8Image grey(picture.width, picture.height);
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.data.data()));
  cv::Mat written(grey.height, grey.width, CV_8UC1, grey.data.data());
  cv::cvtColor(rgb, written, cv::COLOR_RGB2GRAY);
  return grey;
}

image::Grey16Image stepsOf(const image::DepthImage& depth, double steps_per_m, DepthRoom* room) {
  constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
  image::Grey16Image steps(depth.width, depth.height);
  for (std::size_t i = 0; i < depth.data.size(); ++i) {
    if (!std::isfinite(depth.data[i])) continue;
    ++room->seen;
    const double wanted = std::round(static_cast<double>(depth.data[i]) * steps_per_m);
    if (wanted >= 1.0 && wanted <= kMost) {
      steps.data[i] = static_cast<std::uint16_t>(wanted);
    } else {
      ++room->without_room;
    }
  }
  return steps;
}

/// "WIDTH&HEIGHT&1&", behind which COLMAP has the floats, row by row.
std::string headerOfFloats(int width, int height) {
  return std::to_string(width) + '&' + std::to_string(height) + "&1&";
}

std::size_t sizeOfFloats(int width, int height) {
  return headerOfFloats(width, height).size() +
         sizeof(float) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

std::string floatsOf(const image::DepthImage& depth, DepthRoom* room) {
  std::string bytes = headerOfFloats(depth.width, depth.height);
  for (const float value : depth.data) {
    const bool is_seen = std::isfinite(value);
    if (is_seen) ++room->seen;
    const float written = is_seen ? value : 0.0f;
    bytes.append(reinterpret_cast<const char*>(&written), sizeof written);
  }
  return bytes;
}

template <typename Value, int kChannels>
bool isOf(const image::PinholeCamera& camera, const image::Picture<Value, kChannels>& picture) {
  return picture.width == camera.width && picture.height == camera.height;
}

}  // namespace

const std::vector<std::string>& dataSetFormatNames() {
  static const std::vector<std::string> names{"tum", "euroc", "colmap"};
  return names;
}

DataSetFolder::DataSetFolder(const std::string& folder, DataSetFormat format, const DataSetOptions& options)
    : folder_(folder), layout_(layoutOf(format)), options_(options) {
  requireFields(options_.camera);
  sunlit::require("rate", options_.rate_hz, Range::above(0), "Hz");
  depthScaleRow(&options_.depth_scale).require();
  image::baselineRow(&options_.baseline_m).require();
  if (layout_.right_folder.empty()) options_.baseline_m = 0.0;
}

bool DataSetFolder::hasRight() const {
  return options_.baseline_m > 0.0;
}

std::string DataSetFolder::pictureFile(const std::string& of_layout, const DataSetFrame& frame) const {
  return folder_ + '/' + of_layout + layout_.name(frame) + ".png";
}

std::string DataSetFolder::depthFile(const DataSetFrame& frame) const {
  return folder_ + '/' + layout_.depth_folder + layout_.name(frame) + ".png" +
         (layout_.has_float_depth ? ".bin" : "");
}

bool DataSetFolder::has(const DataSetFrame& frame) const {
  const std::string picture = pictureFile(layout_.picture_folder, frame), depth = depthFile(frame);
  const std::string right = pictureFile(layout_.right_folder, frame);
  if (!fs::exists(picture) || !fs::exists(depth) || (hasRight() && !fs::exists(right))) return false;
  try {
    const bool has_depth =
        layout_.has_float_depth
            ? fs::file_size(depth) == sizeOfFloats(options_.camera.width, options_.camera.height)
            : isOf(options_.camera, image::readGrey16Png(depth));
    const bool has_right = !hasRight() || isOf(options_.camera, image::readPng(right));
    return has_depth && has_right && isOf(options_.camera, image::readPng(picture));
  } catch (const std::runtime_error&) {
    return false;  // broken: it is made again
  }
}

DepthRoom DataSetFolder::writeDepth(const std::string& file, const image::DepthImage& depth) const {
  DepthRoom room;
  if (layout_.has_float_depth) {
    image::writeFileAtomically(file, floatsOf(depth, &room));
  } else {
    image::writePng(file, stepsOf(depth, options_.depth_scale, &room));
  }
  return room;
}

DepthRoom DataSetFolder::write(const DataSetFrame& frame, const image::Rgb8Image& picture,
                               const image::DepthImage& depth) const {
  if (!isOf(options_.camera, picture) || !isOf(options_.camera, depth))
    throw std::invalid_argument("picture and depth of a data set must be of its camera's size");
  writePicture(pictureFile(layout_.picture_folder, frame), picture);
  const std::string depth_file = depthFile(frame);
  makeFolderOf(depth_file);
  return writeDepth(depth_file, depth);
}

void DataSetFolder::writePicture(const std::string& file, const image::Rgb8Image& picture) const {
  makeFolderOf(file);
  if (layout_.is_grey) {
    image::writePng(file, greyOf(picture));
  } else {
    image::writePng(file, picture);
  }
}

void DataSetFolder::writeRight(const DataSetFrame& frame, const image::Rgb8Image& picture) const {
  if (!isOf(options_.camera, picture))
    throw std::invalid_argument("the right picture of a data set must be of its camera's size");
  writePicture(pictureFile(layout_.right_folder, frame), picture);
}

void DataSetFolder::finish(const std::vector<DataSetFrame>& frames) const {
  for (const TextFile& file : layout_.texts(options_, frames)) {
    const std::string path = folder_ + '/' + file.path;
    makeFolderOf(path);
    image::writeFileAtomically(path, file.text);
  }
}

}  // namespace sunlit::evaluate
