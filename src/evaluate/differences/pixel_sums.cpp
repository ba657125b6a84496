#include "evaluate/differences/pixel_sums.h"

#include <algorithm>
#include <opencv2/core/hal/intrin.hpp>
#include <stdexcept>
#include <string>

namespace sunlit::evaluate {
namespace {

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

void addRgbBlock(const uchar* a, const uchar* b, int pixels, PixelSums& sums) {
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

void addGreyBlock(const uchar* a, const uchar* b, int pixels, PixelSums& sums) {
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
PixelSums sumsOver(const cv::Mat& a, const cv::Mat& b, AddBlock addBlock) {
  PixelSums sums;
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

PixelSums sumsOf(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size())
    throw std::invalid_argument("images of different sizes, " + sizeOf(a) + " and " + sizeOf(b) +
                                " px, have no difference of pixels");
  PixelSums sums = a.channels() == 1 ? sumsOver(a, b, addGreyBlock) : sumsOver(a, b, addRgbBlock);
  sums.pixels = a.total();
  return sums;
}

}  // namespace sunlit::evaluate
