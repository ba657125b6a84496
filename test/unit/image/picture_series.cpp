#include "sunlit/image/picture_series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "sunlit/image/files.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::image {
namespace {

/// So many pictures, each of one grey of its own.
PictureSeries greys(int count, int width, int height) {
  return {count, [=](int i) {
            Rgb8Image picture(width, height);
            std::fill(picture.data.begin(), picture.data.end(), static_cast<std::uint8_t>(40 * (i + 1)));
            return picture;
          }};
}

TEST(ContactSheet, HasRowsOfPicturesWithGapsBetween) {
  const TemporaryFolder folder;
  const std::string file = folder.file("sheet.png");
  // Five pictures of 3:2 in rows of three, 30 px wide, so 20 px high; gaps of 2 px.
  const SheetLayout layout{3, 30};
  const PictureSize size = sheetSize(layout, 5, 2.0 / 3.0);
  EXPECT_EQ(size.width, 3 * 30 + 2 * 2);
  EXPECT_EQ(size.height, 2 * 20 + 2);
  writeContactSheet(file, layout, greys(5, 60, 40));
  const Rgb8Image sheet = readPng(file);
  ASSERT_EQ(sheet.width, size.width);
  ASSERT_EQ(sheet.height, size.height);
  for (int y = 0; y < sheet.height; ++y) {
    for (int x = 0; x < sheet.width; ++x) {
      const int number = x / 32 + 3 * (y / 22);
      const bool between = x % 32 >= 30 || y % 22 >= 20 || number > 4;
      ASSERT_EQ(*sheet.at(x, y), between ? 0 : 40 * (number + 1)) << x << ", " << y;
    }
  }
}

TEST(ContactSheet, OfFewPicturesIsNoWiderThanThey) {
  const PictureSize size = sheetSize({6, 100}, 2, 1.0);
  EXPECT_EQ(size.width, 202);
  EXPECT_EQ(size.height, 100);
}

TEST(ContactSheet, SaysHowLargeItWouldBeHoweverLarge) {
  EXPECT_EQ(sheetSize({1, 8192}, 100000, 1.0).height, 100000ll * 8194 - 2);
}

TEST(Words, StandWhiteOnDarkInTheLowerLeftCorner) {
  Rgb8Image picture(720, 360);
  std::fill(picture.data.begin(), picture.data.end(), std::uint8_t{128});
  writeInto("04:30", 1.0 / 18.0, &picture);
  int white = 0, black = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int value = *picture.at(x, y);
      white += value == 255;
      black += value == 0;
      // Five letters of 20 px height are narrower than 110 px, their rim and margin less than 20 px.
      const bool in_corner = x < 130 && y > picture.height - 50;
      ASSERT_TRUE(in_corner || value == 128) << x << ", " << y;
    }
  }
  EXPECT_GT(white, 50);
  EXPECT_GT(black, 50);
}

TEST(FilmName, EndsInAKindThatIsKnown) {
  for (const char* name : {"a.mp4", "b/a.avi", "a.mkv"}) EXPECT_NO_THROW(requireFilmName("--video", name));
  for (const char* name : {"a.gif", "mp4", "", "a.mp4/b"}) {
    EXPECT_EQ(messageOf([&] { requireFilmName("--video", name); }),
              "--video is \"" + std::string(name) + "\", but must be a name that ends in .mp4, .avi or .mkv");
  }
}

TEST(Film, IsWholeOrTheOneBefore) {
  const TemporaryFolder folder;
  const std::string file = folder.file("film.mkv");
  writeFilm(file, 5.0, greys(3, 33, 21));  // odd sides too
  const std::string whole = contentOf(file);
  EXPECT_GT(whole.size(), 100u);
  PictureSeries breaking = greys(3, 33, 21);
  breaking.picture = [&, picture = breaking.picture](int i) {
    if (i == 2) throw std::runtime_error("frame 2 is gone");
    return picture(i);
  };
  EXPECT_EQ(messageOf<std::runtime_error>([&] { writeFilm(file, 5.0, breaking); }), "frame 2 is gone");
  EXPECT_EQ(contentOf(file), whole);
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(Film, ThatCannotBeWrittenIsNamed) {
  const std::string nowhere = "/nowhere/film.avi";
  const std::string message =
      messageOf<std::runtime_error>([&] { writeFilm(nowhere, 5.0, greys(1, 32, 16)); });
  EXPECT_EQ(message.rfind(nowhere + ": create: ", 0), 0u) << message;
}

}  // namespace
}  // namespace sunlit::image
