// Pictures of every kind become 8-bit RGBA.
#include "sunlit/image/texture_files.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::image {
namespace {

/// Cyclic redundancy check of PNG (ISO/IEC 15948, annex D).
std::uint32_t checksum(const std::string& text) {
  std::uint32_t sum = 0xFFFFFFFFu;
  for (const char letter : text) {
    sum ^= static_cast<std::uint8_t>(letter);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1u) != 0 ? 0xEDB88320u ^ (sum >> 1) : sum >> 1;
  }
  return ~sum;
}

std::string word(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFF);
  return text;
}

std::string chunk(const std::string& name, const std::string& data) {
  return word(static_cast<std::uint32_t>(data.size())) + name + data + word(checksum(name + data));
}

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

/// A PNG of 1 × 1 px whose samples are `samples`; `color_type` as in PNG (0 grey, 2 RGB, 4 grey and alpha, 6
/// RGBA).
std::string onePixel(int bit_depth, int color_type, const std::string& samples,
                     const std::string& more = "") {
  const std::string row = std::string(1, '\0') + samples;  // filter type 0
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char letter : row) {
    a = (a + static_cast<std::uint8_t>(letter)) % 65521;
    b = (b + a) % 65521;
  }
  const int size = static_cast<int>(row.size());
  // One stored (uncompressed) block of zlib, RFC 1950 and 1951.
  const std::string packed =
      bytes({0x78, 0x01, 0x01, size & 0xFF, size >> 8, ~size & 0xFF, ~size >> 8 & 0xFF}) + row +
      word(b << 16 | a);
  return bytes({0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'}) +
         chunk("IHDR", word(1) + word(1) + bytes({bit_depth, color_type, 0, 0, 0})) + more +
         chunk("IDAT", packed) + chunk("IEND", "");
}

std::vector<int> texelOf(const std::string& file) {
  const Rgba8Image picture =
      decodeRgba(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(), "test");
  return {picture.data.begin(), picture.data.end()};
}

TEST(DecodeRgba, KeepsTheOrderOfChannels) {
  EXPECT_EQ(texelOf(onePixel(8, 6, bytes({10, 20, 30, 40}))), (std::vector<int>{10, 20, 30, 40}));
  EXPECT_EQ(texelOf(onePixel(8, 2, bytes({10, 20, 30}))), (std::vector<int>{10, 20, 30, 255}));
}

TEST(DecodeRgba, GreyBecomesThreeEqualChannels) {
  EXPECT_EQ(texelOf(onePixel(8, 0, bytes({77}))), (std::vector<int>{77, 77, 77, 255}));
  EXPECT_EQ(texelOf(onePixel(8, 4, bytes({77, 5}))), (std::vector<int>{77, 77, 77, 5}));
}

// ISO/IEC 15948, 11.3.2.1: a tRNS chunk has two bytes for any depth, of which the low bits count.
TEST(DecodeRgba, GreyMayCutOutOneOfItsLevels) {
  const auto alphaOf = [](int bits, const std::string& sample, const std::string& level) {
    return texelOf(onePixel(bits, 0, sample, chunk("tRNS", level))).at(3);
  };
  EXPECT_EQ(texelOf(onePixel(8, 0, bytes({77}), chunk("tRNS", bytes({0, 77})))),
            (std::vector<int>{77, 77, 77, 0}));
  EXPECT_EQ(alphaOf(8, bytes({78}), bytes({0, 77})), 255);
  // Two levels of 16 bits that are one of 8.
  EXPECT_EQ(alphaOf(16, bytes({0x80, 0x01}), bytes({0x80, 0x01})), 0);
  EXPECT_EQ(alphaOf(16, bytes({0x80, 0x02}), bytes({0x80, 0x01})), 255);
  // The pixel is the highest bits of its byte: 1, 2 and 9.
  EXPECT_EQ(alphaOf(1, bytes({0x80}), bytes({0, 1})), 0);
  EXPECT_EQ(alphaOf(1, bytes({0x80}), bytes({0, 0})), 255);
  EXPECT_EQ(alphaOf(2, bytes({0x80}), bytes({0, 2})), 0);
  EXPECT_EQ(texelOf(onePixel(4, 0, bytes({0x90}), chunk("tRNS", bytes({0, 9})))),
            (std::vector<int>{153, 153, 153, 0}));
}

TEST(DecodeRgba, SixteenBitsAreRoundedToEight) {
  // 65535 is white and 0x8000 = 32768 of it is 127.5 of 255.
  const std::vector<int> texel = texelOf(onePixel(16, 2, bytes({0xFF, 0xFF, 0x80, 0x00, 0x00, 0x00})));
  EXPECT_EQ(texel[0], 255);
  EXPECT_EQ(texel[1], 128);
  EXPECT_EQ(texel[2], 0);
  EXPECT_EQ(texel[3], 255);
}

TEST(DecodeRgba, AColourProfileIsIgnoredInSilence) {
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(texelOf(onePixel(8, 2, bytes({10, 20, 30}), chunk("iCCP", "nonsense"))),
            (std::vector<int>{10, 20, 30, 255}));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(DecodeRgba, NamesWhatCannotBeDecoded) {
  for (const std::string& broken :
       {std::string(), std::string("GIF"), onePixel(8, 2, bytes({1, 2, 3})).substr(0, 20)}) {
    const std::string error = messageOf<std::runtime_error>([&] { texelOf(broken); });
    EXPECT_EQ(error.find("test: cannot decode this picture"), 0u) << error;
  }
}

/// The header of a TGA, of 2 × 2 px unless `size` says otherwise.
std::string tgaHeader(int type, int bits, int descriptor, const std::string& size = bytes({2, 0, 2, 0})) {
  return bytes({0, 0, type}) + std::string(9, '\0') + size + bytes({bits, descriptor});
}

TEST(DecodeRgba, ReadsTgaOfAllKinds) {
  constexpr int kFromTop = 0x20;
  const std::vector<int> colors = {3, 2, 1, 255, 6, 5, 4, 255, 9, 8, 7, 255, 12, 11, 10, 255};
  const std::string bgr = bytes({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  EXPECT_EQ(texelOf(tgaHeader(2, 24, kFromTop) + bgr), colors);
  // From the bottom, as most are, and from the right.
  EXPECT_EQ(texelOf(tgaHeader(2, 24, 0) + bytes({7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6})), colors);
  EXPECT_EQ(texelOf(tgaHeader(2, 24, 0x30) + bytes({4, 5, 6, 1, 2, 3, 10, 11, 12, 7, 8, 9})), colors);
  // Alpha; where it is 0 all over and the header tells of none, there is none.
  const std::string bgra = bytes({1, 2, 3, 40, 4, 5, 6, 50, 7, 8, 9, 60, 10, 11, 12, 70});
  EXPECT_EQ(texelOf(tgaHeader(2, 32, kFromTop | 8) + bgra),
            (std::vector<int>{3, 2, 1, 40, 6, 5, 4, 50, 9, 8, 7, 60, 12, 11, 10, 70}));
  EXPECT_EQ(texelOf(tgaHeader(2, 32, kFromTop) + bytes({1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 0})),
            colors);
  // Grey.
  EXPECT_EQ(texelOf(tgaHeader(3, 8, kFromTop) + bytes({0, 7, 128, 255})),
            (std::vector<int>{0, 0, 0, 255, 7, 7, 7, 255, 128, 128, 128, 255, 255, 255, 255, 255}));
  // 5 bits a channel: blue, green, red, white.
  EXPECT_EQ(texelOf(tgaHeader(2, 16, kFromTop) + bytes({0x1F, 0, 0xE0, 3, 0, 0x7C, 0xFF, 0x7F})),
            (std::vector<int>{0, 0, 255, 255, 0, 255, 0, 255, 255, 0, 0, 255, 255, 255, 255, 255}));
}

TEST(DecodeRgba, ReadsTgaOfPacketsAndOfColoursByNumber) {
  // Three of one colour, over the end of a row, then one as it is; an identification of two bytes.
  std::string runs = tgaHeader(10, 24, 0x20) + "id" + bytes({0x82, 1, 2, 3, 0x00, 4, 5, 6});
  runs[0] = 2;
  EXPECT_EQ(texelOf(runs), (std::vector<int>{3, 2, 1, 255, 3, 2, 1, 255, 3, 2, 1, 255, 6, 5, 4, 255}));
  // Colours 5 and 6.
  const std::string map = bytes({5, 0, 2, 0, 24}), palette = bytes({1, 2, 3, 4, 5, 6});
  const std::string indexed =
      bytes({0, 1, 1}) + map + std::string(4, '\0') + bytes({2, 0, 2, 0, 8, 0x20}) + palette;
  EXPECT_EQ(texelOf(indexed + bytes({5, 6, 6, 5})),
            (std::vector<int>{3, 2, 1, 255, 6, 5, 4, 255, 6, 5, 4, 255, 3, 2, 1, 255}));
  EXPECT_EQ(messageOf<std::runtime_error>([&] {
              texelOf(indexed + bytes({5, 6, 7, 5}));
            }),
            "test: this TGA picture has a pixel of colour 7, which is none of its own");
  EXPECT_EQ(messageOf<std::runtime_error>([&] {
              texelOf(indexed + bytes({5, 6, 4, 5}));
            }),
            "test: this TGA picture has a pixel of colour 4, which is none of its own");
}

TEST(DecodeRgba, NamesTgaThatIsCutOff) {
  for (const std::string& file :
       {tgaHeader(2, 24, 0) + bytes({1, 2, 3}), tgaHeader(10, 24, 0) + bytes({0x81, 1, 2, 3, 0x81, 1}),
        tgaHeader(10, 24, 0) + bytes({0x81, 1, 2, 3}),
        tgaHeader(10, 24, 0, bytes({255, 255, 255, 255})) + bytes({0x81, 1, 2, 3})})
    EXPECT_EQ(messageOf<std::runtime_error>([&] { texelOf(file); }), "test: this TGA picture is cut off");
  const std::string large = tgaHeader(10, 24, 0, bytes({255, 255, 255, 255}));
  EXPECT_NE(messageOf<std::runtime_error>([&] {
              decodeRgbaWithin(8, reinterpret_cast<const std::uint8_t*>(large.data()), large.size(), "test");
            }).find("test: this picture has 65535 × 65535 px"),
            std::string::npos);
}

TEST(DecodeRgba, NamesFormatsThatAreNotReadAndWhatToDo) {
  const auto error = [](const std::string& format, const std::string& program) {
    return "test: this is a " + format +
           " picture, and not read; PNG, JPEG, BMP, TIFF, TGA, WebP and PPM are understood, whatever the "
           "file's "
           "name: "
           "convert it to PNG, by " +
           program;
  };
  EXPECT_EQ(messageOf<std::runtime_error>([] { texelOf("DDS |" + std::string(124, '\0')); }),
            error("DDS", "ImageMagick or GIMP"));
  EXPECT_EQ(
      messageOf<std::runtime_error>([] { texelOf("\xABKTX 20\xBB\r\n\x1A\n" + std::string(60, '\0')); }),
      error("KTX2", "ktx extract or basisu -unpack"));
}

/// Of 2 × 2 px, all of the same number.
std::string ofFloats(const char* ending, int type, double number) {
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(ending, cv::Mat(2, 2, type, cv::Scalar::all(number)), bytes));
  return {bytes.begin(), bytes.end()};
}

TEST(DecodeRgba, FloatsAreNoValuesOfADisplay) {
  const auto error = [](const std::string& what) {
    return "test: this is a " + what +
           "picture of floats, and not read as a texture; PNG, JPEG, BMP, TIFF, TGA, WebP and PPM are "
           "understood "
           "with 8 or 16 bits a channel: convert it to PNG, by ImageMagick or GIMP";
  };
  const std::string hdr = ofFloats(".hdr", CV_32FC3, 0.18), tiff = ofFloats(".tiff", CV_32FC1, 0.18);
  EXPECT_EQ(messageOf<std::runtime_error>([&] { texelOf(hdr); }), error("Radiance HDR "));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { texelOf(tiff); }), error(""));
  const TemporaryFolder folder;
  setContent(folder.file("heights.tiff"), tiff);
  EXPECT_FLOAT_EQ(*readGreyWithin(8, folder.file("heights.tiff")).values.at(1, 1), 0.18f);
  EXPECT_THROW(readRgbaWithin(8, folder.file("heights.tiff")), std::runtime_error);
}

TEST(EncodePng, LosesNothing) {
  Rgba8Image picture(3, 2);
  for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = static_cast<std::uint8_t>(11 * i);
  const std::string file = encodePng(picture);
  const Rgba8Image back = decodeRgba(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(), "test");
  EXPECT_EQ(back.width, 3);
  EXPECT_EQ(back.height, 2);
  EXPECT_EQ(back.data, picture.data);
}

FittedImage fitted(int longest_px, const std::string& file) {
  return decodeRgbaWithin(longest_px, reinterpret_cast<const std::uint8_t*>(file.data()), file.size(),
                          "test");
}

/// Columns that are black and white in turn.
Rgba8Image stripes(int width, int height) {
  Rgba8Image picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 4; ++c) picture.at(x, y)[c] = c == 3 || x % 2 == 1 ? 255 : 0;
    }
  }
  return picture;
}

TEST(DecodeRgbaWithin, ALargePictureBecomesTheMeanOfItsPixels) {
  const FittedImage image = fitted(20, encodePng(stripes(40, 8)));
  EXPECT_EQ(image.width, 40);
  EXPECT_EQ(image.height, 8);
  ASSERT_EQ(image.picture.width, 20);
  ASSERT_EQ(image.picture.height, 4);
  for (std::size_t i = 0; i < image.picture.data.size(); ++i) {
    if (i % 4 == 3) {
      EXPECT_EQ(image.picture.data[i], 255);
    } else {
      EXPECT_NEAR(image.picture.data[i], 127.5, 0.5);  // of 0 and 255, rounded
    }
  }
  EXPECT_EQ(fitted(40, encodePng(stripes(40, 8))).picture.data, stripes(40, 8).data);
}

TEST(DecodeRgbaWithin, ALargeJpegIsNeverDecodedWhole) {
  const cv::Mat grey(90, 1000, CV_8UC3, cv::Scalar(60, 120, 180));
  std::vector<std::uint8_t> bytes;
  ASSERT_TRUE(cv::imencode(".jpg", grey, bytes));
  const FittedImage image = fitted(100, {bytes.begin(), bytes.end()});
  EXPECT_EQ(image.width, 1000);
  EXPECT_EQ(image.height, 90);
  EXPECT_EQ(image.picture.width, 100);
  // 90 rows are 12 blocks of 8, of which libjpeg gives one pixel each for a side of 125 to 12: 125 × 12. The
  // last of them is not full, and by the JPEG of OpenCV 4.2 no row.
  EXPECT_EQ(image.picture.height, CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR < 5 ? 9 : 10);
  for (const auto& [channel, value] : {std::pair{0, 180}, {1, 120}, {2, 60}})
    EXPECT_NEAR(image.picture.at(50, 5)[channel], value, 3);  // JPEG's own loss of an even colour
}

TEST(DecodeRgbaWithin, RefusesWhatNoMemoryHoldsByItsHeader) {
  std::string file = encodePng(stripes(2, 2));
  file.replace(16, 8, word(40000) + word(30000));  // behind signature, length and name of the first chunk
  EXPECT_EQ(messageOf<std::runtime_error>([&] { fitted(8192, file); }),
            "test: this picture has 40000 × 30000 px, more than the 536870912 that can be read");
}

TEST(ReadRgbaWithin, NamesAMissingFile) {
  EXPECT_THROW(readRgbaWithin(8192, "/nowhere/leaf.png"), std::runtime_error);
}

TEST(CoveredBy, TakesTheOpacityOfAnotherPicture) {
  Rgba8Image picture(1, 1), mask(2, 1), alpha(2, 1);
  picture.data = {10, 20, 30, 255};
  mask.data = {0, 0, 0, 255, 100, 101, 102, 255};  // no alpha: by its brightness
  alpha.data = {255, 255, 255, 7, 0, 0, 0, 255};
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(coveredBy(picture, mask).data, (Bytes{10, 20, 30, 0, 10, 20, 30, 101}));
  EXPECT_EQ(coveredBy(picture, alpha).data, (Bytes{10, 20, 30, 7, 10, 20, 30, 255}));
  EXPECT_EQ(coveredBy(alpha, picture).data, (Bytes{255, 255, 255, 20, 0, 0, 0, 20}));
}

}  // namespace
}  // namespace sunlit::image
