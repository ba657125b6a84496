#include "sunlit/evaluate/picture.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace sunlit::evaluate {

Picture makePicture(const cv::Mat& rgb) {
  if (rgb.empty() || rgb.type() != CV_8UC3) {
    throw std::invalid_argument("an image to evaluate is " + std::to_string(rgb.cols) + "×" +
                                std::to_string(rgb.rows) + " px of OpenCV type " +
                                cv::typeToString(rgb.type()) +
                                ", but must be CV_8UC3 with at least one pixel");
  }
  Picture picture;
  picture.rgb = rgb;
  cv::cvtColor(rgb, picture.grey, cv::COLOR_RGB2GRAY);
  return picture;
}

cv::Mat matOf(image::Rgb8Image& picture) {
  return cv::Mat(picture.height, picture.width, CV_8UC3, picture.data.data());
}

}  // namespace sunlit::evaluate
