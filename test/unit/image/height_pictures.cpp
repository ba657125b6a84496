// Elevation models that have pixels without a height.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "sunlit/image/texture_files.h"
#include "support/temporary_folder.h"

namespace sunlit::image {
namespace {

std::string tiffOf(const cv::Mat& heights) {
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(".tiff", heights, bytes));
  return {bytes.begin(), bytes.end()};
}

std::string numberOf(std::size_t number, std::size_t bytes, bool little) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i)
    text += static_cast<char>(number >> 8 * (little ? i : bytes - 1 - i) & 0xFF);
  return text;
}

/// A TIFF of 2 × 2 px of 16 bits without a sign, with this text of tag 42113.
std::string modelOf(const std::array<std::size_t, 4>& heights, std::string no_data, bool little) {
  no_data += '\0';
  const std::array<std::array<std::size_t, 4>, 9> entries = {
      {{256, 3, 1, 2},  // width
       {257, 3, 1, 2},
       {258, 3, 1, 16},  // bits
       {259, 3, 1, 1},   // as they are
       {262, 3, 1, 1},   // black is 0
       {273, 4, 1, 8},   // where they begin
       {278, 3, 1, 2},
       {279, 4, 1, 8},
       {42113, 2, no_data.size(), 16 + 2 + 9 * 12 + 4}}};
  std::string file = little ? std::string("II*\0", 4) : std::string("MM\0*", 4);
  file += numberOf(16, 4, little);
  for (const std::size_t height : heights) file += numberOf(height, 2, little);
  file += numberOf(entries.size(), 2, little);
  for (const auto& [tag, type, count, value] : entries) {
    file += numberOf(tag, 2, little) + numberOf(type, 2, little) + numberOf(count, 4, little);
    if (tag == 42113 && count <= 4)
      file += no_data + std::string(4 - count, '\0');
    else if (type == 3)
      file += numberOf(value, 2, little) + std::string(2, '\0');
    else
      file += numberOf(value, 4, little);
  }
  return file + numberOf(0, 4, little) + no_data;
}

TEST(ReadGrey, FillsWhatTheFileSaysIsNoHeight) {
  const TemporaryFolder folder;
  const std::string file = folder.file("model.tif");
  for (const bool little : {true, false}) {
    for (const std::string no_data : {"65535", "655.35e2", "0"}) {
      const bool none_is_zero = no_data == "0";
      setContent(file, modelOf({100, 200, none_is_zero ? 0u : 65535u, 300}, no_data, little));
      const GreyPicture grey = readGreyWithin(8, file);
      EXPECT_EQ(grey.filled, 1u) << no_data;
      EXPECT_FLOAT_EQ(*grey.values.at(0, 1), 100.0f / 65535.0f);
      EXPECT_FLOAT_EQ(*grey.values.at(1, 1), 300.0f / 65535.0f);
    }
    setContent(file, modelOf({100, 200, 65535, 300}, "nan", little));
    EXPECT_EQ(readGreyWithin(8, file).filled, 0u);
    const std::string whole = modelOf({100, 200, 65535, 300}, "65535", little);
    setContent(file, whole.substr(0, whole.size() - 3));  // within the text of the tag
    EXPECT_EQ(readGreyWithin(8, file).filled, 0u);
  }
}

TEST(ReadGrey, FillsWhatModelsUsuallyHaveForNoHeight) {
  const TemporaryFolder folder;
  const std::string file = folder.file("model.tiff");
  const float lowest = std::numeric_limits<float>::lowest();
  for (const float none :
       {-9999.0f, -32768.0f, -32767.0f, lowest, -lowest, -3.4e38f, INFINITY, -INFINITY, NAN}) {
    const cv::Mat heights = (cv::Mat_<float>(2, 2) << 5.0f, none, 7.0f, -3.0f);
    setContent(file, tiffOf(heights));
    const GreyPicture grey = readGreyWithin(8, file);
    EXPECT_EQ(grey.filled, 1u) << none;
    EXPECT_EQ(grey.values.data, (std::vector<float>{5.0f, -3.0f, 7.0f, -3.0f}));
    EXPECT_EQ(*readGreyWithin(1, file).values.at(0, 0), 1.5f) << "not a mean with what is none";
  }
  setContent(file, tiffOf(cv::Mat_<float>(2, 2, -9999.0f)));
  EXPECT_EQ(readGreyWithin(8, file).filled, 4u);
  EXPECT_EQ(readGreyWithin(8, file).values.data, std::vector<float>(4, 0.0f));
}

}  // namespace
}  // namespace sunlit::image
