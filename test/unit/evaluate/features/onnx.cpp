// Networks of two convolutions, whose points and descriptors pencil and paper give.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "sunlit/evaluate/features/detector.h"
#include "support/message_of.h"
#include "support/onnx_file.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

constexpr float kGain = 8.0F;
/// One rounding of single precision for each of the 65 terms of a softmax.
constexpr float kRounding = 65 * 6e-8F;

class Onnx : public testing::Test {
 protected:
  std::unique_ptr<Detector> detectorOf(const std::string& bytes,
                                       std::vector<std::pair<std::string, std::string>> values = {}) {
    setContent(file_, bytes);
    std::unique_ptr<Detector> detector = makeDetector("onnx");
    values.emplace_back("model", file_);
    for (const auto& [key, value] : values) fieldOf(detector->fields(), key).setText(value, key);
    return detector;
  }
  static Features find(const Detector& detector, const cv::Mat& grey) {
    return detectFeatures(detector, Picture{{}, grey});
  }

  const TemporaryFolder folder_;
  const std::string file_ = folder_.file("tiny.onnx");
};

/// Black but for these.
cv::Mat greyWith(const cv::Size& size, const std::vector<cv::Point>& bright) {
  cv::Mat grey = cv::Mat::zeros(size, CV_8U);
  for (const cv::Point& p : bright) grey.at<unsigned char>(p) = 255;
  return grey;
}

TEST_F(Onnx, FindsWhatPencilAndPaperDo) {
  // Cells of 8 px: the picture has 4 x 3 of them, and 5 px at its right and 3 below that belong to none.
  const cv::Mat grey = greyWith({37, 27}, {{12, 9}, {20, 17}, {35, 9}, {12, 26}});
  const auto detector = detectorOf(brightPixelNetwork(kGain, 1.0F), {{"threshold", "0.5"}});
  const Features found = find(*detector, grey);
  ASSERT_EQ(found.key_points.size(), 2u);
  // The pixel's channel has e^gain; the 63 other pixels and that of no point have e^0.
  const float score = std::exp(kGain) / (std::exp(kGain) + 64.0F);
  const cv::Point2f expected[] = {{12, 9}, {20, 17}};
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(found.key_points[i].pt, expected[i]);
    EXPECT_NEAR(found.key_points[i].response, score, kRounding);
    EXPECT_EQ(found.key_points[i].size, 8.0F);
    EXPECT_EQ(found.key_points[i].angle, -1.0F);
  }
  // Cells with a bright pixel in the upper half have (1, 0, 1)/sqrt 2, empty ones (0, 0, 1). The point (12,
  // 9) lies at column (12 - 3.5)/8 = 1.0625 and row (9 - 3.5)/8 = 0.6875 of the cells: between four, of which
  // cell (1, 1) alone has its pixel. Likewise (20, 17) at column 2.0625 and row 1.6875.
  ASSERT_EQ(found.descriptors.size(), cv::Size(3, 2));
  const double share = (1.0 - 0.0625) * 0.6875;
  const double first = share / std::sqrt(2.0), last = share / std::sqrt(2.0) + (1.0 - share);
  const double length = std::hypot(first, last);
  for (int i = 0; i < 2; ++i) {
    const float* row = found.descriptors.ptr<float>(i);
    EXPECT_NEAR(row[0], first / length, 1e-6);  // some roundings of single precision
    EXPECT_NEAR(row[1], 0.0, 1e-6);
    EXPECT_NEAR(row[2], last / length, 1e-6);
  }
}

TEST(OnnxFile, IsWhatIsHandedToTheTestsOfPrograms) {
  EXPECT_EQ(contentOf(std::string(SUNLIT_SOURCE_DIR) + "/test/golden/bright_pixel.onnx"),
            brightPixelNetwork(8.0F, 1.0F));
}

TEST_F(Onnx, GoesOnOutwardsBeyondTheOutermostMiddles) {
  const auto detector = detectorOf(brightPixelNetwork(kGain, 0.0F), {{"threshold", "0.5"}, {"border", "0"}});
  const Features found = find(*detector, greyWith({16, 16}, {{0, 7}, {15, 0}}));
  ASSERT_EQ(found.key_points.size(), 2u);
  EXPECT_EQ(found.key_points[0].pt, cv::Point2f(15, 0));
  EXPECT_EQ(found.key_points[1].pt, cv::Point2f(0, 7));
  // Of the cells at its row, the one below is empty and has no direction.
  EXPECT_NEAR(found.descriptors.at<float>(0, 0), 1.0, 1e-6);
  EXPECT_NEAR(found.descriptors.at<float>(1, 1), 1.0, 1e-6);
}

TEST_F(Onnx, KeepsTheStrongestOfNeighboursAndTheBestOfAll) {
  cv::Mat grey = cv::Mat::zeros(64, 64, CV_8U);  // in a cell each, so that the brighter has the higher score
  const std::vector<std::pair<cv::Point, int>> bright = {
      {{30, 30}, 255}, {{30, 35}, 245}, {{3, 40}, 240}, {{50, 12}, 230}, {{33, 30}, 200}};
  for (const auto& [point, value] : bright) grey.at<unsigned char>(point) = static_cast<unsigned char>(value);
  const std::string network = brightPixelNetwork(kGain, 1.0F);
  const auto pointsFor = [&](std::vector<std::pair<std::string, std::string>> values) {
    values.emplace_back("threshold", "0.2");
    std::vector<cv::Point2f> points;
    for (const cv::KeyPoint& point : find(*detectorOf(network, values), grey).key_points)
      points.push_back(point.pt);
    return points;
  };
  using Points = std::vector<cv::Point2f>;
  EXPECT_EQ(pointsFor({}), (Points{{30, 30}, {30, 35}, {50, 12}}));
  EXPECT_EQ(pointsFor({{"nms_radius", "5"}}), (Points{{30, 30}, {50, 12}}));
  EXPECT_EQ(pointsFor({{"nms_radius", "2"}}), (Points{{30, 30}, {30, 35}, {50, 12}, {33, 30}}));
  EXPECT_EQ(pointsFor({{"border", "0"}}), (Points{{30, 30}, {30, 35}, {3, 40}, {50, 12}}));
  EXPECT_EQ(pointsFor({{"border", "13"}}), (Points{{30, 30}, {30, 35}}));
  EXPECT_EQ(pointsFor({{"max_features", "2"}}), (Points{{30, 30}, {30, 35}}));
  EXPECT_EQ(pointsFor({{"border", "40"}}), Points{});
}

TEST_F(Onnx, FindsNothingInWhatIsEmptyOrSmallerThanACell) {
  const auto detector = detectorOf(brightPixelNetwork(kGain, 1.0F), {{"threshold", "0.5"}});
  for (const cv::Size& size : {cv::Size(7, 640), cv::Size(640, 7), cv::Size(64, 64)}) {
    const Features found = find(*detector, cv::Mat::zeros(size, CV_8U));
    EXPECT_TRUE(found.key_points.empty());
    EXPECT_EQ(found.descriptors.rows, 0);
  }
}

/// Weights drawn at random, so that every order of sums rounds in its own way: 3 x 3 px, as in networks of
/// this kind, and then heads of whole cells.
std::string randomNetwork() {
  cv::RNG random(7);
  const auto layer = [&](const std::string& output, const std::string& input, std::uint64_t channels,
                         std::uint64_t input_channels, std::uint64_t side) {
    Convolution made{output,
                     std::vector<float>(channels * input_channels * side * side),
                     std::vector<float>(channels),
                     input,
                     input_channels,
                     side};
    const auto bound = static_cast<float>(2.0 / std::sqrt(static_cast<double>(input_channels * side * side)));
    for (std::vector<float>* values : {&made.weights, &made.biases}) {
      for (float& value : *values) value = random.uniform(-bound, bound);
    }
    if (side == 3) made.stride = made.padding = 1;
    made.is_output = side == 8;
    return made;
  };
  return onnxFile({layer("first", "image", 16, 1, 3), layer("second", "first", 24, 16, 3),
                   layer("semi", "second", 65, 24, 8), layer("desc", "second", 256, 24, 8)});
}

TEST_F(Onnx, FindsTheSameForAnyNumberOfThreadsAndAtTheSameTime) {
  const auto detector = detectorOf(randomNetwork());
  cv::Mat grey(243, 322, CV_8U);
  cv::RNG(3).fill(grey, cv::RNG::UNIFORM, 0, 256);
  const Features expected = find(*detector, grey);
  ASSERT_GT(expected.key_points.size(), 100u);
  const auto expectSame = [&](const Features& found) {
    ASSERT_EQ(found.key_points.size(), expected.key_points.size());
    for (std::size_t i = 0; i < found.key_points.size(); ++i) {
      ASSERT_EQ(found.key_points[i].pt, expected.key_points[i].pt);
      ASSERT_EQ(found.key_points[i].response, expected.key_points[i].response);
    }
    ASSERT_EQ(cv::norm(found.descriptors, expected.descriptors, cv::NORM_INF), 0.0);
  };
  for (const int threads : {1, 2, 3, 5, 16}) {
    cv::setNumThreads(threads);
    expectSame(find(*detector, grey));
    std::vector<Features> together(4);
    tbb::task_arena(threads).execute(
        [&] { tbb::parallel_for(0, 4, [&](int i) { together[i] = find(*detector, grey); }); });
    for (const Features& found : together) expectSame(found);
  }
  cv::setNumThreads(-1);
}

TEST_F(Onnx, TellsNetworksOfOneNameApart) {
  const auto hashOf = [](Detector& detector) { return fieldOf(detector.fields(), "model_hash").text(); };
  const auto first = detectorOf(brightPixelNetwork(kGain, 1.0F));
  EXPECT_EQ(hashOf(*first).size(), 32u);
  const std::string before = hashOf(*first);
  const auto second = detectorOf(brightPixelNetwork(kGain, 2.0F));
  EXPECT_NE(hashOf(*second), before);
  EXPECT_EQ(hashOf(*first->clone()), before) << "what was read is what is used";
  const auto none = makeDetector("onnx");
  for (const Field& row : none->fields()) EXPECT_NE(row.key, "model_hash");
}

TEST_F(Onnx, NamesFileLayerAndShapeOfWhatItCannotUse) {
  EXPECT_EQ(messageOf([] { makeDetector("onnx")->make(); }),
            "model of onnx is \"\", but must be the file of a network in the ONNX format");
  const auto missing = detectorOf("");
  fieldOf(missing->fields(), "model").setText(file_ + "x", "");
  EXPECT_NE(messageOf<std::runtime_error>([&] { missing->make(); }).find(file_ + "x: "), std::string::npos);
  const auto foreign = detectorOf("P6 640 480 255");
  EXPECT_EQ(
      messageOf([&] { foreign->make(); }).rfind(file_ + ": OpenCV cannot use it as an ONNX network: ", 0),
      0u);
  const Convolution few{"few", std::vector<float>(64 * 64), std::vector<float>(64)};
  const Convolution whole{"whole", std::vector<float>(65 * 64), std::vector<float>(65)};
  const cv::Mat grey = cv::Mat::zeros(24, 33, CV_8U);
  const std::string wanted = ", but must give points, 1×65×3×4, and descriptors, 1×D×3×4";
  const auto saysOf = [&](const std::vector<Convolution>& outputs) {
    const auto detector = detectorOf(onnxFile(outputs));
    return messageOf<std::runtime_error>([&] { find(*detector, grey); });
  };
  const std::string begins = file_ + ": of a picture of 32×24 px the network gives layer ";
  EXPECT_EQ(saysOf({few}), begins + "few 1×64×3×4" + wanted);
  EXPECT_EQ(saysOf({whole}), begins + "whole 1×65×3×4" + wanted);
  Convolution again = whole;
  again.output = "again";
  EXPECT_NE(saysOf({whole, again}).find(wanted), std::string::npos);
  Convolution wild = whole;
  wild.biases[3] = INFINITY;
  EXPECT_EQ(saysOf({wild, few}), file_ + ": layer whole gives what is no number");
}

}  // namespace
}  // namespace sunlit::evaluate
