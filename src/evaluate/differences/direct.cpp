#include "sunlit/evaluate/differences/direct.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace sunlit::evaluate {
namespace {

struct Sums {
  std::uint64_t squares = 0;
  std::uint64_t unequal = 0;
};

inline unsigned squareOf(int difference) {
  return static_cast<unsigned>(difference * difference);
}

#if CV_SIMD128
// Σ (a − b)² of 16 values, as four partial sums.
inline cv::v_uint32x4 squares16(const cv::v_uint8x16& a, const cv::v_uint8x16& b) {
  cv::v_uint16x8 low;
  cv::v_uint16x8 high;
  cv::v_expand(cv::v_absdiff(a, b), low, high);
  const cv::v_int16x8 low_signed = cv::v_reinterpret_as_s16(low);
  const cv::v_int16x8 high_signed = cv::v_reinterpret_as_s16(high);
  return cv::v_reinterpret_as_u32(cv::v_dotprod(low_signed, low_signed) +
                                  cv::v_dotprod(high_signed, high_signed));
}

// 1 in each byte where `equal` is 0.
inline cv::v_uint8x16 ones(const cv::v_uint8x16& equal) {
  return cv::v_setall_u8(1) & ~equal;
}

inline std::uint64_t sumOfBytes(const cv::v_uint8x16& bytes) {
  return cv::v_reduce_sum(bytes);
}
#endif

// At most 255 steps of 16 pixels: byte counters cannot overflow, nor can the 32 bit sum of all lanes
// (255 steps · 16 pixels · 3 channels · 255² < 2³²).
constexpr int kStep = 16;
constexpr int kBlock = 255 * kStep;

void addRgbBlock(const uchar* a, const uchar* b, int pixels, Sums& sums) {
  int x = 0;
#if CV_SIMD128
  cv::v_uint32x4 squares = cv::v_setzero_u32();
  cv::v_uint8x16 unequal = cv::v_setzero_u8();
  for (; x + kStep <= pixels; x += kStep) {
    cv::v_uint8x16 ar, ag, ab, br, bg, bb;
    cv::v_load_deinterleave(a + 3 * x, ar, ag, ab);
    cv::v_load_deinterleave(b + 3 * x, br, bg, bb);
    squares += squares16(ar, br) + squares16(ag, bg) + squares16(ab, bb);
    unequal += ones((ar == br) & (ag == bg) & (ab == bb));
  }
  sums.squares += cv::v_reduce_sum(squares);
  sums.unequal += sumOfBytes(unequal);
#endif
  for (; x < pixels; ++x) {
    const uchar* p = a + 3 * x;
    const uchar* q = b + 3 * x;
    sums.squares += squareOf(p[0] - q[0]) + squareOf(p[1] - q[1]) + squareOf(p[2] - q[2]);
    sums.unequal += (p[0] != q[0] || p[1] != q[1] || p[2] != q[2]) ? 1 : 0;
  }
}

void addGreyBlock(const uchar* a, const uchar* b, int pixels, Sums& sums) {
  int x = 0;
#if CV_SIMD128
  cv::v_uint32x4 squares = cv::v_setzero_u32();
  cv::v_uint8x16 unequal = cv::v_setzero_u8();
  for (; x + kStep <= pixels; x += kStep) {
    const cv::v_uint8x16 va = cv::v_load(a + x);
    const cv::v_uint8x16 vb = cv::v_load(b + x);
    squares += squares16(va, vb);
    unequal += ones(va == vb);
  }
  sums.squares += cv::v_reduce_sum(squares);
  sums.unequal += sumOfBytes(unequal);
#endif
  for (; x < pixels; ++x) {
    sums.squares += squareOf(a[x] - b[x]);
    sums.unequal += a[x] != b[x] ? 1 : 0;
  }
}

template <typename AddBlock>
Sums sumsOver(const cv::Mat& a, const cv::Mat& b, AddBlock addBlock) {
  Sums sums;
  const int channels = a.channels();
  for (int y = 0; y < a.rows; ++y) {
    const uchar* row_a = a.ptr<uchar>(y);
    const uchar* row_b = b.ptr<uchar>(y);
    for (int x = 0; x < a.cols; x += kBlock) {
      addBlock(row_a + channels * x, row_b + channels * x, std::min(kBlock, a.cols - x), sums);
    }
  }
  return sums;
}

std::string sizeOf(const cv::Mat& image) {
  return std::to_string(image.cols) + "×" + std::to_string(image.rows);
}

}  // namespace

Picture makePicture(const cv::Mat& rgb) {
  if (rgb.empty() || rgb.type() != CV_8UC3) {
    throw std::invalid_argument("an image to evaluate is " + sizeOf(rgb) + " px of OpenCV type " +
                                cv::typeToString(rgb.type()) +
                                ", but must be CV_8UC3 with at least one pixel");
  }
  Picture picture;
  picture.rgb = rgb;
  cv::cvtColor(rgb, picture.grey, cv::COLOR_RGB2GRAY);
  return picture;
}

DirectDifferences directDifferences(const Picture& a, const Picture& b) {
  if (a.rgb.size() != b.rgb.size())
    throw std::invalid_argument("images of different sizes, " + sizeOf(a.rgb) + " and " + sizeOf(b.rgb) +
                                " px, have no direct difference");
  const Sums rgb = sumsOver(a.rgb, b.rgb, addRgbBlock);
  const Sums grey = sumsOver(a.grey, b.grey, addGreyBlock);
  const double pixels = static_cast<double>(a.rgb.total());
  constexpr double kFullScale = 255.0 * 255.0;
  DirectDifferences result;
  result.boolean_rgb = static_cast<double>(rgb.unequal) / pixels;
  result.boolean_grey = static_cast<double>(grey.unequal) / pixels;
  result.euclidean_rgb = static_cast<double>(rgb.squares) / (3.0 * kFullScale * pixels);
  result.euclidean_grey = static_cast<double>(grey.squares) / (kFullScale * pixels);
  return result;
}

}  // namespace sunlit::evaluate
