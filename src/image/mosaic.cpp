#include "sunlit/image/mosaic.h"

#include <array>
#include <opencv2/imgproc.hpp>

namespace sunlit::image {
namespace {

struct Kind {
  std::array<std::size_t, 4> channels;  ///< of the first two pixels of the first row and of the second
  /// By Demosaic. OpenCV calls a pattern after its second row and second column: BG is RGGB.
  std::array<int, 3> conversions;
};

const Kind& kindOf(MosaicPattern pattern) {
  static const std::array<Kind, 4> kinds = {
      {{{0, 1, 1, 2}, {cv::COLOR_BayerBG2RGB, cv::COLOR_BayerBG2RGB_VNG, cv::COLOR_BayerBG2RGB_EA}},
       {{2, 1, 1, 0}, {cv::COLOR_BayerRG2RGB, cv::COLOR_BayerRG2RGB_VNG, cv::COLOR_BayerRG2RGB_EA}},
       {{1, 0, 2, 1}, {cv::COLOR_BayerGB2RGB, cv::COLOR_BayerGB2RGB_VNG, cv::COLOR_BayerGB2RGB_EA}},
       {{1, 2, 0, 1}, {cv::COLOR_BayerGR2RGB, cv::COLOR_BayerGR2RGB_VNG, cv::COLOR_BayerGR2RGB_EA}}}};
  return kinds[static_cast<std::size_t>(pattern) - 1];  // none has no kind
}

/// By variable numbers of gradients OpenCV up to 4.11 draws two rows above where the picture is: how many
/// this one does, by a red pixel alone.
int rowsTooHigh() {
  constexpr int kSide = 32, kPlace = 16;
  cv::Mat mosaic(kSide, kSide, CV_8UC1, cv::Scalar(0)), seen;
  mosaic.at<std::uint8_t>(kPlace, kPlace) = 255;
  cv::demosaicing(mosaic, seen, cv::COLOR_BayerBG2RGB_VNG);
  for (int y = 0; y < kSide; ++y)
    if (seen.at<cv::Vec3b>(y, kPlace)[0] == 255) return kPlace - y;
  return 0;
}

/// With a border that shifted rows come from: an even one, so that the pattern stays.
void demosaicByGradients(const cv::Mat& mosaic, int conversion, cv::Mat* picture) {
  static const int too_high = rowsTooHigh();
  constexpr int kBorder = 8;
  cv::Mat wide, seen;
  cv::copyMakeBorder(mosaic, wide, kBorder, kBorder, kBorder, kBorder, cv::BORDER_REFLECT_101);
  cv::demosaicing(wide, seen, conversion);
  seen(cv::Rect(kBorder, kBorder - too_high, mosaic.cols, mosaic.rows)).copyTo(*picture);
}

}  // namespace

Rgb8Image throughMosaic(Rgb8Image picture, const MosaicOptions& options) {
  if (options.pattern == MosaicPattern::kNone) return picture;
  const Kind& kind = kindOf(options.pattern);
  Grey8Image mosaic(picture.width, picture.height);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto place = static_cast<std::size_t>(y % 2 * 2 + x % 2);
      *mosaic.at(x, y) = picture.at(x, y)[kind.channels[place]];
    }
  }
  const cv::Mat seen(mosaic.height, mosaic.width, CV_8UC1, mosaic.data.data());
  cv::Mat whole(picture.height, picture.width, CV_8UC3, picture.data.data());
  const int conversion = kind.conversions[static_cast<std::size_t>(options.demosaic)];
  if (options.demosaic == Demosaic::kVng)
    demosaicByGradients(seen, conversion, &whole);
  else
    cv::demosaicing(seen, whole, conversion);
  return picture;
}

}  // namespace sunlit::image
