#include "sunlit/image/picture_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "sunlit/image/files.h"
#include "sunlit/image/unfinished_file.h"
#include "sunlit/quantity/range.h"

namespace sunlit::image {

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

/// Called `key` where it is refused.
const Film& filmOf(const std::string& key, const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const Film& film : films()) {
    if (ending == film.ending) return film;
  }
  refuse(key, '"' + path + '"', "a name that ends in .mp4, .avi or .mkv");
}

/// What OpenCV has to say of codecs that it lacks, and of films that it cannot read, is said here.
class QuietOpenCv {
 public:
  QuietOpenCv() : usual_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpenCv() { cv::utils::logging::setLogLevel(usual_); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  const cv::utils::logging::LogLevel usual_;
};

/// Not opened where no codec can be had.
cv::VideoWriter opened(const Film& film, const std::string& path, double frame_rate_hz,
                       const cv::Size& size) {
  for (const auto& c : film.codecs) {
    cv::VideoWriter writer(path, cv::VideoWriter::fourcc(c[0], c[1], c[2], c[3]), frame_rate_hz, size);
    if (writer.isOpened()) return writer;
  }
  return {};
}

/// Shares the memory of `picture`.
cv::Mat matOf(Rgb8Image* picture) {
  return cv::Mat(picture->height, picture->width, CV_8UC3, picture->data.data());
}

/// Most codecs halve the resolution of colour, so their pictures have even sides.
cv::Mat evenSided(const cv::Mat& picture) {
  cv::Mat even;
  cv::copyMakeBorder(picture, even, 0, picture.rows % 2, 0, picture.cols % 2, cv::BORDER_REPLICATE);
  return even;
}

/// How many frames of this size can be read from a film; 0 for what is no film.
int framesIn(const std::string& path, const cv::Size& size) {
  cv::VideoCapture reader(path);
  const cv::Size found(static_cast<int>(reader.get(cv::CAP_PROP_FRAME_WIDTH)),
                       static_cast<int>(reader.get(cv::CAP_PROP_FRAME_HEIGHT)));
  int count = 0;
  while (found == size && reader.grab()) ++count;
  return count;
}

constexpr int kGapPx = 2;  // between the pictures of a sheet

int thumbnailHeight(const SheetLayout& layout, double height_over_width) {
  return std::max(1, static_cast<int>(std::lround(layout.width_px * height_over_width)));
}

}  // namespace

void writeInto(const std::string& text, double share, Rgb8Image* picture) {
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

void requireFilmName(const std::string& key, const std::string& path) {
  filmOf(key, path);
}

void writeFilm(const std::string& path, double frame_rate_hz, const PictureSeries& series) {
  const Film& film = filmOf("film", path);
  const QuietOpenCv quiet;
  UnfinishedFile unfinished(path, film.ending);
  cv::VideoWriter writer;
  cv::Size size;
  for (int i = 0; i < series.count; ++i) {
    Rgb8Image picture = series.picture(i);
    cv::Mat bgr;
    cv::cvtColor(evenSided(matOf(&picture)), bgr, cv::COLOR_RGB2BGR);
    size = bgr.size();
    if (!writer.isOpened()) {
      writer = opened(film, unfinished.path().string(), frame_rate_hz, size);
      if (!writer.isOpened())
        throw std::runtime_error(
            path + ": cannot be written: OpenCV has no codec for it here, or nothing can be written there");
    }
    writer.write(bgr);
  }
  writer.release();
  // Where a disk was full, say, no writer of films tells.
  const int whole = framesIn(unfinished.path().string(), size);
  if (whole != series.count) {
    throw std::runtime_error(path + ": cannot be written: of " + std::to_string(series.count) +
                             " frames only " + std::to_string(whole) +
                             " can be read back; is the disk full?");
  }
  unfinished.keep();
}

PictureSize sheetSize(const SheetLayout& layout, int count, double height_over_width) {
  const int across = std::min(layout.columns, count);
  const int down = (count + across - 1) / across;
  const int height_px = thumbnailHeight(layout, height_over_width);
  return {across * (layout.width_px + std::int64_t{kGapPx}) - kGapPx,
          down * (height_px + std::int64_t{kGapPx}) - kGapPx};
}

void writeContactSheet(const std::string& path, const SheetLayout& layout, const PictureSeries& series) {
  const int across = std::min(layout.columns, series.count);
  Rgb8Image sheet;
  int height_px = 0;
  for (int i = 0; i < series.count; ++i) {
    Rgb8Image picture = series.picture(i);
    if (i == 0) {
      const double shape = 1.0 * picture.height / picture.width;
      const PictureSize size = sheetSize(layout, series.count, shape);
      height_px = thumbnailHeight(layout, shape);
      sheet = Rgb8Image(static_cast<int>(size.width), static_cast<int>(size.height));
    }
    const cv::Rect place(i % across * (layout.width_px + kGapPx), i / across * (height_px + kGapPx),
                         layout.width_px, height_px);
    cv::Mat small = matOf(&sheet)(place);
    const bool shrinks = layout.width_px < picture.width;
    cv::resize(matOf(&picture), small, small.size(), 0.0, 0.0, shrinks ? cv::INTER_AREA : cv::INTER_CUBIC);
  }
  writePng(path, sheet);
}

}  // namespace sunlit::image
