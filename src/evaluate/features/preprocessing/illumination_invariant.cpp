#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "evaluate/features/preprocessings.h"
#include "sunlit/image/srgb.h"

namespace sunlit::evaluate {
namespace {

constexpr double kOfGrey = 0.5;  // equation (3)
// Levels: e times more green, or e times less, is as far as they reach.
constexpr double kLevelOfGrey = 128.0;
constexpr double kLevelsPerUnit = 127.0;

using Logarithms = std::array<double, 256>;  // of linear light, by code

Logarithms logarithms() {
  const std::array<float, 256>& linear = image::linearOfSrgb();
  Logarithms logs;
  for (std::size_t code = 0; code < logs.size(); ++code)
    logs[code] = std::log(static_cast<double>(linear[std::max<std::size_t>(code, 1)]));
  return logs;
}

class IlluminationInvariant : public Preprocessing {
 public:
  std::unique_ptr<Preprocessing> clone() const override {
    return std::make_unique<IlluminationInvariant>(*this);
  }
  std::vector<Field> fields() override {
    return {{"peak_red", &red_nm_, "nm", {560, 780}, "where the red channel sees most"},
            {"peak_green", &green_nm_, "nm", {500, 560}, "likewise the green one"},
            {"peak_blue", &blue_nm_, "nm", {380, 500}, "likewise the blue one"}};
  }
  cv::Mat of(const Picture& picture) const override {
    static const Logarithms logs = logarithms();
    const double share = alpha();
    std::array<Logarithms, 3> terms;  // of red, green and blue
    for (std::size_t code = 0; code < logs.size(); ++code) {
      terms[0][code] = (share - 1.0) * logs[code];
      terms[1][code] = logs[code];
      terms[2][code] = -share * logs[code];
    }
    cv::Mat levels(picture.rgb.size(), CV_8U);
    for (int y = 0; y < levels.rows; ++y) {
      const auto* rgb = picture.rgb.ptr<cv::Vec3b>(y);
      auto* row = levels.ptr<uchar>(y);
      for (int x = 0; x < levels.cols; ++x)
        row[x] = levelOf(kOfGrey + terms[0][rgb[x][0]] + terms[1][rgb[x][1]] + terms[2][rgb[x][2]]);
    }
    return levels;
  }

 private:
  static uchar levelOf(double value) {
    const double level = kLevelOfGrey + kLevelsPerUnit * (value - kOfGrey);
    return static_cast<uchar>(std::lround(std::clamp(level, 0.0, 255.0)));
  }

  // Equation (4).
  double alpha() const { return (1.0 / green_nm_ - 1.0 / red_nm_) / (1.0 / blue_nm_ - 1.0 / red_nm_); }

  // The dominant wavelengths of sRGB's primaries (ITU-R BT.709) against white D65. They make α 0.358; of
  // black bodies of 3000 to 20,000 K by the CIE 1931 observer it is 0.355 to 0.377.
  double red_nm_ = 611.4;
  double green_nm_ = 549.1;
  double blue_nm_ = 464.2;
};

}  // namespace

std::unique_ptr<Preprocessing> makeIlluminationInvariant() {
  return std::make_unique<IlluminationInvariant>();
}

}  // namespace sunlit::evaluate
