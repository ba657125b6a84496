// A network in SuperPoint's layout, by cv::dnn: D. DeTone, T. Malisiewicz, A. Rabinovich, "SuperPoint:
// Self-Supervised Interest Point Detection and Description", CVPR Workshops 2018, sections 3.2 and 3.3.
#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <stdexcept>
#include <utility>

#include "evaluate/features/detectors.h"
#include "sunlit/image/content_hash.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

constexpr int kCell = 8;                           ///< px along each side of what one column of outputs is of
constexpr int kPointChannels = kCell * kCell + 1;  ///< one a pixel, and one for no point

struct OnnxOptions {
  std::string model;
  double threshold = 0.015;
  int nms_radius = 4;
  int border = 4;
  int max_features = 0;
};

/// What a file held when it was read.
struct Network {
  std::string file, bytes, hash;
};

std::shared_ptr<const Network> readNetwork(const std::string& file) {
  Network network{file, image::readWholeFile(file), ""};
  image::ContentHash hash;
  hash.addBytes(network.bytes.data(), network.bytes.size());
  network.hash = hash.text();
  return std::make_shared<const Network>(std::move(network));
}

std::string shapeOf(const cv::Mat& output) {
  std::string text;
  for (int i = 0; i < output.dims; ++i) text += (i == 0 ? "" : "×") + std::to_string(output.size[i]);
  return text;
}

/// Score of each pixel: softmax over the channels, without that of no point, each cell laid out row by row.
cv::Mat scoresOf(const cv::Mat& points) {
  const int rows = points.size[2], columns = points.size[3];
  cv::Mat scores(rows * kCell, columns * kCell, CV_32F);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      float values[kPointChannels];
      for (int c = 0; c < kPointChannels; ++c) values[c] = points.ptr<float>(0, c, y)[x];
      const float most = *std::max_element(values, values + kPointChannels);
      float sum = 0.0F;
      for (float& value : values) sum += value = std::exp(value - most);
      for (int c = 0; c < kPointChannels - 1; ++c)
        scores.at<float>(y * kCell + c / kCell, x * kCell + c % kCell) = values[c] / sum;
    }
  }
  return scores;
}

/// Strongest first, row by row among equals; of those within `nms_radius` of each other, along either side of
/// the picture, the strongest.
std::vector<cv::KeyPoint> strongestOf(const cv::Mat& scores, const OnnxOptions& options) {
  std::vector<cv::Point> candidates;
  for (int y = 0; y < scores.rows; ++y) {
    for (int x = 0; x < scores.cols; ++x) {
      if (scores.at<float>(y, x) >= options.threshold) candidates.emplace_back(x, y);
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [&](const cv::Point& a, const cv::Point& b) {
    return scores.at<float>(a) > scores.at<float>(b);
  });
  const cv::Rect all({0, 0}, scores.size());
  const cv::Rect inner(options.border, options.border, scores.cols - 2 * options.border,
                       scores.rows - 2 * options.border);
  const int side = 2 * options.nms_radius + 1;
  cv::Mat suppressed = cv::Mat::zeros(scores.size(), CV_8U);
  std::vector<cv::KeyPoint> points;
  for (const cv::Point& p : candidates) {
    if (suppressed.at<unsigned char>(p) != 0) continue;
    suppressed(cv::Rect(p.x - options.nms_radius, p.y - options.nms_radius, side, side) & all) = 1;
    if (!inner.contains(p)) continue;
    points.emplace_back(cv::Point2f(p), static_cast<float>(kCell), -1.0F, scores.at<float>(p));
    if (options.max_features > 0 && static_cast<int>(points.size()) == options.max_features) break;
  }
  return points;
}

/// `numbers` of them, to length 1; all 0 stay so.
void normalise(float* numbers, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += static_cast<double>(numbers[i]) * numbers[i];
  if (sum == 0.0) return;
  for (int i = 0; i < count; ++i) numbers[i] = static_cast<float>(numbers[i] / std::sqrt(sum));
}

/// Rows of length 1, one a cell, row by row.
cv::Mat cellsOf(const cv::Mat& descriptors) {
  const int channels = descriptors.size[1], cells = descriptors.size[2] * descriptors.size[3];
  const cv::Mat planes(channels, cells, CV_32F, const_cast<unsigned char*>(descriptors.data));
  cv::Mat rows = planes.t();
  for (int i = 0; i < cells; ++i) normalise(rows.ptr<float>(i), channels);
  return rows;
}

/// Between the cells whose middles a point lies between; the outermost ones go on outwards.
cv::Mat descriptorsAt(const std::vector<cv::KeyPoint>& points, const cv::Mat& cells, const cv::Size& grid) {
  cv::Mat descriptors(static_cast<int>(points.size()), cells.cols, CV_32F);
  const auto within = [](float at, int count) {
    return std::clamp((at - 0.5F * (kCell - 1)) / kCell, 0.0F, static_cast<float>(count - 1));
  };
  for (int i = 0; i < descriptors.rows; ++i) {
    const float x = within(points[i].pt.x, grid.width), y = within(points[i].pt.y, grid.height);
    const int left = static_cast<int>(x), top = static_cast<int>(y);
    const int right = std::min(left + 1, grid.width - 1), bottom = std::min(top + 1, grid.height - 1);
    const float u = x - static_cast<float>(left), v = y - static_cast<float>(top);
    const float* const corners[] = {
        cells.ptr<float>(top * grid.width + left), cells.ptr<float>(top * grid.width + right),
        cells.ptr<float>(bottom * grid.width + left), cells.ptr<float>(bottom * grid.width + right)};
    float* const row = descriptors.ptr<float>(i);
    for (int c = 0; c < cells.cols; ++c) {
      row[c] = (1.0F - v) * ((1.0F - u) * corners[0][c] + u * corners[1][c]) +
               v * ((1.0F - u) * corners[2][c] + u * corners[3][c]);
    }
    normalise(row, cells.cols);
  }
  return descriptors;
}

class OnnxWorker : public cv::Feature2D {
 public:
  OnnxWorker(OnnxOptions options, std::shared_ptr<const Network> network)
      : options_(std::move(options)), network_(std::move(network)) {
    try {
      net_ = cv::dnn::readNetFromONNX(network_->bytes.data(), network_->bytes.size());
      net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
      net_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
      names_ = net_.getUnconnectedOutLayersNames();
    } catch (const cv::Exception& error) {
      throw std::invalid_argument(options_.model + ": OpenCV cannot use it as an ONNX network: " + error.err);
    }
  }
  cv::String getDefaultName() const override { return options_.model; }
  int descriptorType() const override { return CV_32F; }
  int defaultNorm() const override { return cv::NORM_L2; }
  bool empty() const override { return false; }

  void detectAndCompute(cv::InputArray image, cv::InputArray mask, std::vector<cv::KeyPoint>& keypoints,
                        cv::OutputArray descriptors, bool use_provided_keypoints) override {
    CV_Assert(!use_provided_keypoints && mask.empty() && image.type() == CV_8UC1);
    keypoints.clear();
    descriptors.release();
    // Below and right of the last whole cell there are no points: filling up would invent edges there.
    const cv::Size grid = image.size() / kCell;
    if (grid.empty()) return;
    const cv::Mat grey = image.getMat()(cv::Rect({0, 0}, grid * kCell));
    const Outputs outputs = outputsOf(grey, grid);
    keypoints = strongestOf(scoresOf(outputs.points), options_);
    descriptors.assign(descriptorsAt(keypoints, cellsOf(outputs.descriptors), grid));
  }

 private:
  struct Outputs {
    cv::Mat points, descriptors;
  };

  Outputs outputsOf(const cv::Mat& grey, const cv::Size& grid) {
    std::vector<cv::Mat> outputs;
    net_.setInput(cv::dnn::blobFromImage(grey, 1.0 / 255.0));
    net_.forward(outputs, names_);
    Outputs found;
    bool is_clear = true;
    const auto take = [&](cv::Mat* place, const cv::Mat& output) {
      is_clear = is_clear && place->empty();
      *place = output;
    };
    for (const cv::Mat& output : outputs) {
      const bool is_grid = output.dims == 4 && output.type() == CV_32F && output.size[0] == 1 &&
                           output.size[2] == grid.height && output.size[3] == grid.width;
      if (is_grid) take(output.size[1] == kPointChannels ? &found.points : &found.descriptors, output);
    }
    if (!is_clear || found.points.empty() || found.descriptors.empty()) refuseShapes(outputs, grey, grid);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      if (!cv::checkRange(outputs[i].reshape(1, 1)))
        throw std::runtime_error(options_.model + ": layer " + names_[i] + " gives what is no number");
    }
    return found;
  }

  [[noreturn]] void refuseShapes(const std::vector<cv::Mat>& outputs, const cv::Mat& grey,
                                 const cv::Size& grid) const {
    std::string present;
    for (std::size_t i = 0; i < outputs.size(); ++i)
      present += (i == 0 ? "layer " : ", layer ") + names_[i] + " " + shapeOf(outputs[i]);
    const std::string cells = "×" + std::to_string(grid.height) + "×" + std::to_string(grid.width);
    throw std::runtime_error(options_.model + ": of a picture of " + std::to_string(grey.cols) + "×" +
                             std::to_string(grey.rows) + " px the network gives " + present +
                             ", but must give points, 1×" + std::to_string(kPointChannels) + cells +
                             ", and descriptors, 1×D" + cells);
  }

  OnnxOptions options_;
  std::shared_ptr<const Network> network_;
  cv::dnn::Net net_;
  std::vector<cv::String> names_;
};

class Onnx : public Detector {
 public:
  std::unique_ptr<Detector> clone() const override { return std::make_unique<Onnx>(*this); }
  std::string version() const override { return "onnx"; }
  std::vector<Field> fields() override {
    std::vector<Field> rows = {
        {"model", &options_.model, "", {}, "file of the network, ONNX; required"},
        {"threshold", &options_.threshold, "", {0, 1}, "of the score; weaker points are left out"},
        {"nms_radius", &options_.nms_radius, "px", {0, 100}, "within which only the strongest point stays"},
        {"border", &options_.border, "px", {0, 1000}, "of the picture without key points"},
        {"max_features", &options_.max_features, "", {0, kMostFeatures}, "best ones kept; 0: all"}};
    // Beside the name, so that another network under it is noticed. What cannot be read make() refuses.
    network_ = network();
    if (network_) {
      rows.push_back(
          {"model_hash", OwnForm{network_->hash}, "", {}, "of the file's content, as xxhsum -H2 prints it"});
    }
    return rows;
  }
  int norm() const override { return cv::NORM_L2; }
  cv::Ptr<cv::Feature2D> make() const override {
    if (options_.model.empty()) refuse("model of onnx", "\"\"", "the file of a network in the ONNX format");
    const auto present = network();
    return cv::makePtr<OnnxWorker>(options_, present ? present : readNetwork(options_.model));
  }

 private:
  /// Read once for the detector and its clones made later; null where it cannot be.
  std::shared_ptr<const Network> network() const {
    if (network_ && network_->file == options_.model) return network_;
    if (options_.model.empty()) return nullptr;
    try {
      return readNetwork(options_.model);
    } catch (const std::runtime_error&) {
      return nullptr;
    }
  }
  OnnxOptions options_;
  std::shared_ptr<const Network> network_;
};

}  // namespace

std::unique_ptr<Detector> makeOnnx() {
  return std::make_unique<Onnx>();
}

}  // namespace sunlit::evaluate
