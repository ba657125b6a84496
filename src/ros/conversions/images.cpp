#include "ros/conversions/images.h"

#include <sensor_msgs/fill_image.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <climits>
#include <opencv2/core.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "sunlit/image/files.h"

namespace sunlit::ros_interface {

namespace {

template <typename Value, int kChannels>
sensor_msgs::ImagePtr packed(const image::Picture<Value, kChannels>& picture, const std_msgs::Header& header,
                             const std::string& encoding) {
  const cv::Mat pixels(picture.height, picture.width, CV_MAKETYPE(cv::DataType<Value>::depth, kChannels),
                       const_cast<Value*>(picture.data.data()));  // only read
  return toImageMessage(pixels, encoding, header);
}

/// Without coefficients there is none, whatever the model is called, nor where zeros have no model.
image::Distortion distortionOf(const sensor_msgs::CameraInfo& info) {
  const bool is_zero = std::all_of(info.D.begin(), info.D.end(), [](double value) { return value == 0.0; });
  if (info.D.empty() || (is_zero && info.distortion_model.empty())) return {};
  image::Distortion distortion;
  Field model{
      "camera_info/distortion_model", choiceOf(&distortion.model, image::lensModelNames()), "", {}, ""};
  model.set(info.distortion_model, model.key);
  distortion.coefficients = info.D;
  image::requireCoefficients(distortion, "camera_info/D");
  return distortion;
}

}  // namespace

sensor_msgs::ImagePtr toImageMessage(const cv::Mat& pixels, const std::string& encoding,
                                     const std_msgs::Header& header) {
  const cv::Mat whole = pixels.isContinuous() ? pixels : pixels.clone();
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  sensor_msgs::fillImage(*message, encoding, static_cast<std::uint32_t>(whole.rows),
                         static_cast<std::uint32_t>(whole.cols),
                         static_cast<std::uint32_t>(whole.cols * whole.elemSize()), whole.data);
  message->is_bigendian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
  return message;
}

sensor_msgs::ImagePtr toImageMessage(const image::Rgb8Image& picture, const std_msgs::Header& header) {
  return packed(picture, header, sensor_msgs::image_encodings::RGB8);
}

sensor_msgs::ImagePtr toImageMessage(const image::DepthImage& depth, const std_msgs::Header& header) {
  return packed(depth, header, sensor_msgs::image_encodings::TYPE_32FC1);
}

sensor_msgs::CompressedImagePtr toPngMessage(const image::Rgb8Image& picture,
                                             const std_msgs::Header& header) {
  const std::string png = image::encodePng(picture);
  auto message = boost::make_shared<sensor_msgs::CompressedImage>();
  message->header = header;
  message->format = "rgb8; png compressed bgr8";
  message->data.assign(png.begin(), png.end());
  return message;
}

sensor_msgs::CameraInfo toCameraInfo(const image::Calibration& calibration, const std_msgs::Header& header) {
  const image::PinholeCamera& camera = calibration.camera;
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = image::nameOf(calibration.distortion.model);
  info.D = calibration.distortion.coefficients;
  info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  std::copy(calibration.rectification.begin(), calibration.rectification.end(), info.R.begin());
  std::copy(calibration.projection.begin(), calibration.projection.end(), info.P.begin());
  return info;
}

image::Calibration fromCameraInfo(const sensor_msgs::CameraInfo& info) {
  if (info.K[1] != 0.0) refuse("camera_info/K[1], the skew,", textOf(info.K[1]), "0");
  const bool is_whole = (info.roi.width == 0 || info.roi.width == info.width) &&
                        (info.roi.height == 0 || info.roi.height == info.height);
  if (info.binning_x > 1 || info.binning_y > 1 || !is_whole)
    throw std::invalid_argument("camera_info has binning or a region of interest, but must have neither");
  if (info.width > INT_MAX || info.height > INT_MAX) throw std::invalid_argument("camera_info has no size");
  image::Calibration read;
  read.camera = {static_cast<int>(info.width),
                 static_cast<int>(info.height),
                 info.K[0],
                 info.K[4],
                 info.K[2],
                 info.K[5]};
  for (const Field& field : under("camera_info", fieldsOf(read.camera))) field.require();
  read.distortion = distortionOf(info);
  std::copy(info.R.begin(), info.R.end(), read.rectification.begin());
  std::copy(info.P.begin(), info.P.end(), read.projection.begin());
  return read;
}

bool isRectified(const std::string& topic) {
  std::istringstream words(topic);
  for (std::string word; std::getline(words, word, '/');)
    if (word == "image_rect" || word.compare(0, 11, "image_rect_") == 0) return true;
  return false;
}

image::Calibration fromCameraInfo(const sensor_msgs::CameraInfo& info, const std::string& topic) {
  image::Calibration read = fromCameraInfo(info);
  if (!isRectified(topic)) return read;
  if (info.P[0] == 0.0)
    throw std::invalid_argument("camera_info has no P, but pictures of " + topic + " are rectified");
  read.camera.fx = info.P[0];
  read.camera.fy = info.P[5];
  read.camera.cx = info.P[2];
  read.camera.cy = info.P[6];
  for (const Field& field : under("camera_info", fieldsOf(read.camera))) field.require();
  read.distortion = {};
  return read;
}

}  // namespace sunlit::ros_interface
