/// Pictures and cameras to ROS messages. Pure functions.
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>
#include <string>

#include "sunlit/image/calibration.h"
#include "sunlit/image/images.h"

namespace sunlit::ros_interface {

/// Of pixels that are in `encoding`.
sensor_msgs::ImagePtr toImageMessage(const cv::Mat& pixels, const std::string& encoding,
                                     const std_msgs::Header& header);
/// Encoding rgb8.
sensor_msgs::ImagePtr toImageMessage(const image::Rgb8Image& picture, const std_msgs::Header& header);
/// Without loss; the format is named as compressed_image_transport does.
sensor_msgs::CompressedImagePtr toPngMessage(const image::Rgb8Image& picture, const std_msgs::Header& header);
/// Encoding 32FC1, m as render::Renderer::depth(), NaN where there is nothing (REP-117, REP-118).
sensor_msgs::ImagePtr toImageMessage(const image::DepthImage& depth, const std_msgs::Header& header);
/// All numbers as they are.
sensor_msgs::CameraInfo toCameraInfo(const image::Calibration& camera, const std_msgs::Header& header);
/// Throws std::invalid_argument, saying what is wrong, for skew, binning or a region of interest, for a model
/// that image::lensModelNames() does not have or another number of coefficients than it has, and for numbers
/// out of the ranges of fieldsOf(PinholeCamera).
image::Calibration fromCameraInfo(const sensor_msgs::CameraInfo& info);
/// Whether the pictures of `topic` are straightened already, as ROS names such: image_rect, image_rect_color,
/// and what transports send below these.
bool isRectified(const std::string& topic);
/// Of pictures of `topic`: where they are rectified the camera is that of P, without distortion. Throws
/// likewise.
image::Calibration fromCameraInfo(const sensor_msgs::CameraInfo& info, const std::string& topic);

}  // namespace sunlit::ros_interface
