#include "sunlit/image/encoded_size.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace sunlit::image {
namespace {

std::vector<std::uint8_t> encoded(const std::string& ending, int width, int height, int type = CV_8UC3) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(ending, cv::Mat(height, width, type, cv::Scalar::all(100)), bytes);
  return bytes;
}

std::optional<EncodedPicture> of(const std::vector<std::uint8_t>& bytes) {
  return encodedPicture(bytes.data(), bytes.size());
}

TEST(EncodedSize, IsThatWhichAnEncoderWasGiven) {
  for (const std::string ending : {".png", ".jpg"}) {
    for (const int type : {CV_8UC1, CV_8UC3}) {
      const auto picture = of(encoded(ending, 321, 123, type));
      ASSERT_TRUE(picture) << ending;
      EXPECT_EQ(picture->width, 321u);
      EXPECT_EQ(picture->height, 123u);
      EXPECT_EQ(picture->is_lossy, ending == ".jpg");
      EXPECT_EQ(picture->is_grey, type == CV_8UC1);
      EXPECT_FALSE(picture->is_cut_short);
    }
  }
}

TEST(EncodedSize, IsNoneOfOtherBytesAndOfAHeadCutShort) {
  EXPECT_FALSE(encodedPicture(nullptr, 0));
  EXPECT_FALSE(of({0xFF}));
  EXPECT_FALSE(of({0xFF, 0xD8}));
  EXPECT_FALSE(of({0xFF, 0xD8, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}));
  EXPECT_FALSE(of(encoded(".bmp", 8, 8)));
  const auto png = encoded(".png", 8, 8);
  EXPECT_FALSE(of({png.begin(), png.begin() + 25}));
  EXPECT_TRUE(of({png.begin(), png.begin() + 26}));
}

TEST(EncodedSize, TellsWhetherAPngIsWhole) {
  const auto png = encoded(".png", 8, 8);
  for (std::size_t size = 26; size < png.size(); ++size)
    EXPECT_TRUE(of({png.begin(), png.begin() + static_cast<std::ptrdiff_t>(size)})->is_cut_short) << size;
  auto filled = png;
  filled.resize(filled.size() + 7, 0);
  EXPECT_FALSE(of(filled)->is_cut_short);
}

// Memory checkers see where anything beyond the end is read.
TEST(EncodedSize, StaysWithinAnyPartOfAJpeg) {
  const auto jpeg = encoded(".jpg", 8, 8);
  bool was_found = false;
  for (std::size_t size = 0; size < jpeg.size(); ++size) {
    const std::vector<std::uint8_t> part(jpeg.begin(), jpeg.begin() + static_cast<std::ptrdiff_t>(size));
    const auto picture = of(part);
    EXPECT_FALSE(was_found && !picture) << size;
    was_found = was_found || picture;
    if (picture) {
      EXPECT_TRUE(picture->is_cut_short) << size;
    }
  }
  EXPECT_TRUE(was_found);
  auto filled = jpeg;
  filled.resize(filled.size() + 7, 0);  // as some writers do
  EXPECT_FALSE(of(filled)->is_cut_short);
  auto with_film = jpeg;
  for (const char letter : std::string("ftypmp42")) with_film.push_back(static_cast<std::uint8_t>(letter));
  EXPECT_FALSE(of(with_film)->is_cut_short);
}

}  // namespace
}  // namespace sunlit::image
