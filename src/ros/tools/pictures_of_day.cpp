#include "ros/tools/pictures_of_day.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <vector>

#include "sunlit/image/files.h"

namespace sunlit::tools {

namespace {

/// Codecs of a kind of film, the best first: which of them there are depends on how OpenCV was built.
struct Film {
  const char* ending;
  std::vector<std::array<char, 4>> codecs;
};

const std::vector<Film>& films() {
  static const std::vector<Film> all = {{".mp4", {{'a', 'v', 'c', '1'}, {'m', 'p', '4', 'v'}}},
                                        {".avi", {{'M', 'J', 'P', 'G'}}},
                                        {".mkv", {{'F', 'F', 'V', '1'}}}};
  return all;
}

const Film& filmOf(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const Film& film : films()) {
    if (ending == film.ending) return film;
  }
  throw std::invalid_argument("--video is \"" + path + "\", must end with .mp4, .avi or .mkv");
}

cv::VideoWriter opened(const Film& film, const std::string& path, double frame_rate, const cv::Size& size) {
  for (const auto& c : film.codecs) {
    cv::VideoWriter writer(path, cv::VideoWriter::fourcc(c[0], c[1], c[2], c[3]), frame_rate, size);
    if (writer.isOpened()) return writer;
  }
  throw std::runtime_error(path + ": this OpenCV cannot write such a film here");
}

/// Shares the memory of `picture`.
cv::Mat matOf(image::Rgb8Image* picture) {
  return cv::Mat(picture->height, picture->width, CV_8UC3, picture->data.data());
}

/// Most codecs halve the resolution of colour, so their pictures have even sides.
cv::Mat evenSided(const cv::Mat& picture) {
  cv::Mat even;
  cv::copyMakeBorder(picture, even, 0, picture.rows % 2, 0, picture.cols % 2, cv::BORDER_REPLICATE);
  return even;
}

}  // namespace

void writeInto(const std::string& text, double share, image::Rgb8Image* picture) {
  constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
  constexpr double kUnitHeightPx = 21.0;  // of this font's capitals at scale 1
  cv::Mat mat = matOf(picture);
  const double scale = picture->height * share / kUnitHeightPx;
  const int stroke = std::max(1, static_cast<int>(std::lround(1.6 * scale)));
  const int margin = picture->height / 36 + 1;
  const cv::Point at(margin, picture->height - margin);
  cv::putText(mat, text, at, kFont, scale, cv::Scalar::all(0), 3 * stroke, cv::LINE_AA);
  cv::putText(mat, text, at, kFont, scale, cv::Scalar::all(255), stroke, cv::LINE_AA);
}

void requireVideoName(const std::string& path) {
  filmOf(path);
}

void writeVideo(const std::string& path, double frame_rate, const Frames& frames) {
  const Film& film = filmOf(path);
  const std::string unfinished = path + ".part" + film.ending;
  cv::VideoWriter writer;
  for (int i = 0; i < frames.count; ++i) {
    image::Rgb8Image frame = frames.read(i);
    cv::Mat bgr;
    cv::cvtColor(evenSided(matOf(&frame)), bgr, cv::COLOR_RGB2BGR);
    if (!writer.isOpened()) writer = opened(film, unfinished, frame_rate, bgr.size());
    writer.write(bgr);
  }
  writer.release();
  std::filesystem::rename(unfinished, path);
}

void writeContactSheet(const std::string& path, int columns, int width_px, const Frames& frames) {
  constexpr int kGapPx = 2;
  const int across = std::min(columns, frames.count);
  const int down = (frames.count + across - 1) / across;
  image::Rgb8Image sheet;
  int height_px = 0;
  for (int i = 0; i < frames.count; ++i) {
    image::Rgb8Image frame = frames.read(i);
    if (i == 0) {
      height_px = std::max(1, static_cast<int>(std::lround(1.0 * width_px * frame.height / frame.width)));
      sheet = image::Rgb8Image(across * (width_px + kGapPx) - kGapPx, down * (height_px + kGapPx) - kGapPx);
    }
    const cv::Rect place(i % across * (width_px + kGapPx), i / across * (height_px + kGapPx), width_px,
                         height_px);
    cv::Mat small = matOf(&sheet)(place);
    const bool shrinks = width_px < frame.width;
    cv::resize(matOf(&frame), small, small.size(), 0.0, 0.0, shrinks ? cv::INTER_AREA : cv::INTER_CUBIC);
  }
  image::writePng(path, sheet);
}

}  // namespace sunlit::tools
