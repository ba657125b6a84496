#include "sunlit/evaluate/places/place_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "evaluate/files/files.h"
#include "sunlit/image/codecs.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {

void writePlaces(const std::string& path, const std::vector<PlaceRow>& rows) {
  std::string text =
      "method,queries,recall_1,recall_5,recall_10,pr_auc,recall_at_100_precision,without_truth\n";
  for (const PlaceRow& row : rows) {
    const PlaceScores& scores = row.scores;
    text += csvField(row.method) + ',' + std::to_string(scores.queries);
    for (const double value :
         {scores.recall_1, scores.recall_5, scores.recall_10, scores.pr_auc, scores.recall_at_100_precision})
      text += ',' + formatNumber(value);
    text += ',' + std::to_string(scores.without_truth) + '\n';
  }
  image::writeFileAtomically(path, text);
}

void writeMatrix(const std::string& path, const PlaceMatrix& matrix, const MatrixNames& names) {
  std::string text = "query";
  for (const std::string& place : names.places) text += ',' + csvField(place);
  text += '\n';
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    text += csvField(names.queries[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) text += ',' + formatNumber(matrix(i, j));
    text += '\n';
  }
  image::writeFileAtomically(path, text);
}

void drawMatrix(const std::string& path, const PlaceMatrix& matrix) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (Eigen::Index k = 0; k < matrix.size(); ++k) {
    const double value = matrix.data()[k];
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  const double scale = greatest > least ? 255.0 / (greatest - least) : 0.0;
  cv::Mat picture(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()), CV_8UC1);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double value = matrix(y, x);
      picture.at<std::uint8_t>(y, x) =
          std::isfinite(value) ? static_cast<std::uint8_t>(std::lround((value - least) * scale)) : 255;
    }
  }
  const std::vector<std::uint8_t> bytes = image::encodePicture(".png", picture);
  if (bytes.empty()) throw std::runtime_error(path + ": PNG encoder failed");
  image::writeFileAtomically(path, {bytes.begin(), bytes.end()});
}

}  // namespace sunlit::evaluate
