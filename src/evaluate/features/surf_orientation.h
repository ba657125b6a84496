// The dominant direction about a key point (Bay et al. 2008, 4.1).
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

namespace sunlit::evaluate::surf {

// Scale in px of a key point's size: the smallest filter, 9 px, stands for a Gaussian of 1.2 px.
inline float scaleOfSize(float size) {
  return size * 1.2f / 9.0f;
}

class Orientation {
 public:
  Orientation();

  // The side in px of the Haar wavelets about a key point: the even number next to four scales.
  static int waveletSize(float size);

  // Direction of the key point in degrees, [0, 360); nothing where no wavelet fits into the image.
  // `integral`: CV_32S, one row and column more than the image and larger than the wavelet.
  std::optional<float> of(const cv::KeyPoint& point, const cv::Mat& integral) const;

 private:
  static constexpr int kRadius = 6;     // scales
  static constexpr int kSamples = 113;  // grid points within the circle of that radius
  struct Sample {
    float dx, dy;  // scales
    float weight;
  };
  struct Responses {
    std::array<float, kSamples> x, y, angle_deg;
    int count = 0;
  };
  Responses responses(const cv::KeyPoint& point, const cv::Mat& integral) const;
  std::array<Sample, kSamples> samples_;
};

}  // namespace sunlit::evaluate::surf
