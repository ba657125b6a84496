#include "support/compare_pictures.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace sunlit::test {
namespace {

image::Rgb8Image grey(std::uint8_t level) {
  image::Rgb8Image picture(4, 4);
  for (std::uint8_t& value : picture.data) {
    value = level;
  }
  return picture;
}

TEST(PicturesMatch, EqualPicturesDo) {
  EXPECT_TRUE(picturesMatch(grey(7), grey(7), {}, "equal"));
}

TEST(PicturesMatch, LargestAndMeanAreBothHeld) {
  image::Rgb8Image other = grey(100);
  other.at(2, 3)[1] = 112;  // one of 48 values: mean 0.25
  EXPECT_TRUE(picturesMatch(other, grey(100), {12, 0.25}, "held"));
  EXPECT_FALSE(picturesMatch(other, grey(100), {11, 0.25}, "largest"));
  EXPECT_FALSE(picturesMatch(other, grey(100), {12, 0.24}, "mean"));
  EXPECT_FALSE(picturesMatch(grey(1), image::Rgb8Image(4, 5), {255, 255.0}, "size"));
}

TEST(PicturesMatch, FailureLeavesAPictureOfTheDifference) {
  image::Rgb8Image other = grey(100);
  other.at(2, 3)[1] = 90;
  const testing::AssertionResult result = picturesMatch(other, grey(100), {}, "one_pixel");
  ASSERT_FALSE(result);
  const std::string message = result.message();
  EXPECT_NE(message.find("largest difference 10 at (2, 3)"), std::string::npos) << message;
  const std::string path = message.substr(message.rfind("see ") + 4);
  const image::Rgb8Image picture = image::readPng(path);
  EXPECT_EQ(picture.at(2, 3)[1], 80);
  EXPECT_EQ(picture.at(2, 2)[1], 0);
}

}  // namespace
}  // namespace sunlit::test
