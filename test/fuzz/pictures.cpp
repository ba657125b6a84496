// Pictures of every kind that is read: textures, height maps, compressed images of topics, float maps.
#include <opencv2/imgcodecs.hpp>

#include "fuzz/reader.h"
#include "fuzz/scene_extras.h"
#include "sunlit/image/encoded_size.h"
#include "sunlit/image/files.h"

namespace sunlit::fuzz {
namespace {

std::string encoded(const char* ending, int type) {
  cv::Mat picture(7, 12, type);
  for (int y = 0; y < picture.rows; ++y) {
    for (std::size_t i = 0; i < picture.cols * picture.elemSize(); ++i)
      picture.ptr(y)[i] = static_cast<unsigned char>(37 * y + 11 * i);
  }
  std::vector<unsigned char> bytes;
  cv::imencode(ending, picture, bytes);
  return {bytes.begin(), bytes.end()};
}

std::string floatMap(const std::string& kind, std::size_t numbers) {
  return kind + "\n3 2\n-1.0\n" + std::string(4 * numbers, '\x3e');
}

/// A TGA of 3 × 2 px: indexed, of true colour with alpha, and in packets.
std::string tga(const std::string& begin, const std::string& end, const std::string& content) {
  return begin + std::string("\0\0\0\0\3\0\2\0", 8) + end + content;
}

}  // namespace

std::vector<std::string> seeds() {
  return {encoded(".png", CV_8UC3),
          encoded(".png", CV_16UC1),
          encoded(".png", CV_8UC4),
          encoded(".jpg", CV_8UC3),
          encoded(".jpg", CV_8UC1),
          encoded(".bmp", CV_8UC3),
          encoded(".tiff", CV_8UC3),
          encoded(".webp", CV_8UC3),
          encoded(".tiff", CV_16UC1),
          floatMap("Pf", 6),
          floatMap("PF", 18),
          tga(std::string("\0\1\1\0\0\2\0\x18", 8), "\x08 ", "abcdef" + std::string("\0\1\1\0\0\1", 6)),
          tga(std::string("\0\0\2\0\0\0\0\0", 8), " (", "abcdefghijklmnopqrstuvwx"),
          tga(std::string("\0\0\x0A\0\0\0\0\0", 8), std::string("\x18\0", 2),
              "\x82"
              "abc\x02"
              "defghijkl")};
}

void read(const std::string& input) {
  setContent("./input.png", input);
  if (input.compare(0, 2, "PF") == 0) {
    image::readLinearPfm("input.png");
  } else if (input.compare(0, 2, "Pf") == 0) {
    image::readDepthPfm("input.png");
  } else {
    image::encodedPicture(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    image::readRgbaWithin(4, "input.png");
    image::readGreyWithin(4096, "input.png");
  }
}

std::string named() {
  return "input.png";
}

}  // namespace sunlit::fuzz
