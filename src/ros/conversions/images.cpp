#include "ros/conversions/images.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <climits>
#include <opencv2/core.hpp>
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
  return cv_bridge::CvImage(header, encoding, pixels).toImageMsg();
}

}  // namespace

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

image::PinholeCamera fromCameraInfo(const sensor_msgs::CameraInfo& info) {
  const auto isNot0 = [](double number) { return number != 0.0; };
  if (std::any_of(info.D.begin(), info.D.end(), isNot0))
    throw std::invalid_argument("camera_info has distortion: rectify the images first (image_proc)");
  if (const std::string& model = info.distortion_model; model == image::nameOf(image::LensModel::kEquidistant) ||
                                                        model == image::nameOf(image::LensModel::kOmni))
    throw std::invalid_argument("camera_info is of a lens that is " + model +
                                ": rectify the images first (image_proc)");
  if (info.K[1] != 0.0) throw std::invalid_argument("camera_info has skew, but must have none");
  const bool is_whole = (info.roi.width == 0 || info.roi.width == info.width) &&
                        (info.roi.height == 0 || info.roi.height == info.height);
  if (info.binning_x > 1 || info.binning_y > 1 || !is_whole)
    throw std::invalid_argument("camera_info has binning or a region of interest, but must have neither");
  if (info.width > INT_MAX || info.height > INT_MAX) throw std::invalid_argument("camera_info has no size");
  image::PinholeCamera camera{static_cast<int>(info.width),
                              static_cast<int>(info.height),
                              info.K[0],
                              info.K[4],
                              info.K[2],
                              info.K[5]};
  for (const Field& field : under("camera_info", fieldsOf(camera))) field.require();
  return camera;
}

}  // namespace sunlit::ros_interface
