#include "sunlit/evaluate/places/vlad.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <random>

#include "support/message_of.h"

namespace sunlit::evaluate {
namespace {

constexpr float kFloatRounding = 1e-6F;  // numbers up to 1 are kept as float

cv::Mat pointsOf(const std::vector<std::vector<float>>& rows) {
  cv::Mat points;
  for (const std::vector<float>& row : rows) points.push_back(cv::Mat(row, true).reshape(1, 1));
  return points;
}

cv::Mat randomPoints(int count, int coordinates) {
  std::mt19937 generator(3);
  cv::Mat points(count, coordinates, CV_32FC1);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < coordinates; ++k)
      points.at<float>(i, k) = static_cast<float>(generator() >> 8) * 0x1p-24F;
  }
  return points;
}

bool sameBits(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

TEST(VladPoints, AreRootsOfSharesForSift) {
  const cv::Mat points = vladPoints({cv::NORM_L2, true}, (cv::Mat_<std::uint8_t>(2, 3) << 9, 16, 0, 0, 0, 0));
  EXPECT_EQ(points.at<float>(0, 0), 3.0F / 5.0F);
  EXPECT_EQ(points.at<float>(0, 1), 4.0F / 5.0F);
  EXPECT_EQ(cv::countNonZero(points.row(1)), 0);
}

TEST(VladPoints, AreBitsWhereAHammingNormCompares) {
  const cv::Mat bytes = (cv::Mat_<std::uint8_t>(2, 2) << 0b00000101, 0b10000000, 0b11111111, 0);
  const cv::Mat points = vladPoints({cv::NORM_HAMMING}, bytes);
  const cv::Mat expected = pointsOf(
      {{1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0}});
  EXPECT_TRUE(sameBits(points, expected));
  const double distance = cv::norm(points.row(0), points.row(1), cv::NORM_L2);
  EXPECT_NEAR(distance * distance, cv::norm(bytes.row(0), bytes.row(1), cv::NORM_HAMMING), 1e-12);
}

TEST(VladPoints, AreTheNumbersThemselvesOtherwise) {
  const cv::Mat numbers = pointsOf({{0.25F, -0.5F}});
  EXPECT_TRUE(sameBits(vladPoints({cv::NORM_L2}, numbers), numbers));
  EXPECT_TRUE(vladPoints({cv::NORM_L2}, {}).empty());
}

TEST(Vocabulary, HasTheMeansOfGroupsThatLieApart) {
  // Four groups of three around the corners of a square; the mean of each is its corner.
  std::vector<std::vector<float>> rows;
  for (const float step : {-1.0F, 0.0F, 1.0F}) {
    for (const auto& [x, y] : {std::pair(0, 0), {100, 0}, {0, 100}, {100, 100}})
      rows.push_back({static_cast<float>(x) + step, static_cast<float>(y) - step});
  }
  const cv::Mat words = trainVocabulary(pointsOf(rows), 4, 1);
  ASSERT_EQ(words.rows, 4);
  float sum = 0.0F;
  for (int w = 0; w < 4; ++w) {
    const float x = words.at<float>(w, 0), y = words.at<float>(w, 1);
    EXPECT_TRUE((x == 0.0F || x == 100.0F) && (y == 0.0F || y == 100.0F)) << x << ' ' << y;
    sum += x + 3.0F * y;
  }
  EXPECT_EQ(sum, 800.0F);  // all four: 0, 100, 300 and 400
}

TEST(Vocabulary, IsTheSameForAnyNumberOfThreadsAndFromRunToRun) {
  const cv::Mat points = randomPoints(5000, 24);
  const cv::Mat many = trainVocabulary(points, kVisualWords, kVocabularySeed);
  EXPECT_TRUE(sameBits(trainVocabulary(points, kVisualWords, kVocabularySeed), many));
  EXPECT_FALSE(sameBits(trainVocabulary(points, kVisualWords, kVocabularySeed + 1), many));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(sameBits(trainVocabulary(points, kVisualWords, kVocabularySeed), many));
}

TEST(Vocabulary, IsNoWorseThanThatOfOpenCv) {
  const cv::Mat points = randomPoints(3000, 8);
  const cv::Mat words = trainVocabulary(points, 32, 1);
  double own = 0.0;
  for (int i = 0; i < points.rows; ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (int w = 0; w < words.rows; ++w)
      least = std::min(least, cv::norm(points.row(i), words.row(w), cv::NORM_L2SQR));
    own += least;
  }
  cv::Mat labels;
  cv::setRNGSeed(1);
  const double theirs =
      cv::kmeans(points, 32, labels, {cv::TermCriteria::COUNT, 50, 0.0}, 1, cv::KMEANS_PP_CENTERS);
  // Both are local minima of the same sum. From seed to seed it varies by about 1 %.
  EXPECT_NEAR(own / theirs, 1.0, 0.03);
}

TEST(Vocabulary, NeedsAsManyDifferentPointsAsWords) {
  const cv::Mat twins = pointsOf({{1, 2}, {1, 2}, {3, 4}, {3, 4}});
  EXPECT_EQ(trainVocabulary(twins, 2, 1).rows, 2);
  EXPECT_EQ(messageOf([&] { trainVocabulary(twins, 3, 1); }),
            "different descriptors of the map are 2, but must be at least 3, one for each visual word");
  EXPECT_NE(messageOf([&] { trainVocabulary({}, 3, 1); }).find("are 0, but"), std::string::npos);
}

TEST(Vlad, FollowsFromPencilAndPaper) {
  const cv::Mat words = pointsOf({{0, 0}, {10, 0}, {0, 10}});
  // The first two are off the first word by (3, 0) + (0, 4), length 5; the third off the second by (0, −2);
  // the last word has none. Each block has length 1, both √½ of the whole.
  const cv::Mat vlad = vladOf(pointsOf({{3, 0}, {0, 4}, {10, -2}}), words);
  const float half = std::sqrt(0.5F);
  const float expected[6] = {0.6F * half, 0.8F * half, 0.0F, -half, 0.0F, 0.0F};
  ASSERT_EQ(vlad.size(), cv::Size(6, 1));
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(vlad.at<float>(k), expected[k], kFloatRounding) << k;
}

TEST(Vlad, GivesAPointBetweenTwoWordsToTheFirst) {
  const cv::Mat vlad = vladOf(pointsOf({{5, 0}}), pointsOf({{0, 0}, {10, 0}}));
  EXPECT_EQ(vlad.at<float>(0), 1.0F);
  EXPECT_EQ(vlad.at<float>(2), 0.0F);
}

TEST(Vlad, IsZeroWithoutPointsAndOnItsWords) {
  const cv::Mat words = pointsOf({{0, 0}, {10, 0}});
  EXPECT_EQ(cv::countNonZero(vladOf({}, words)), 0);
  EXPECT_EQ(vladOf({}, words).size(), cv::Size(4, 1));
  EXPECT_EQ(cv::countNonZero(vladOf(words, words)), 0);
}

TEST(VladDistances, AreEuclideanAndInfiniteForWhatKnowsNothing) {
  const std::vector<cv::Mat> vlads = {pointsOf({{1, 0}}), pointsOf({{0, -1}}), pointsOf({{-1, 0}}),
                                      pointsOf({{0, 0}})};
  const PlaceMatrix distances = vladDistances(vlads, vlads);
  EXPECT_EQ(distances(0, 0), 0.0);
  EXPECT_EQ(distances(0, 1), std::sqrt(2.0));
  EXPECT_EQ(distances(0, 2), 2.0);
  for (Eigen::Index k = 0; k < 4; ++k) {
    EXPECT_TRUE(std::isinf(distances(3, k)));  // not 0 to another that knows nothing
    EXPECT_TRUE(std::isinf(distances(k, 3)));
  }
}

TEST(VladDistances, AreThoseOfOpenCvForAnyNumberOfThreads) {
  std::vector<cv::Mat> vlads;
  const cv::Mat points = randomPoints(400, 17);
  const cv::Mat words = trainVocabulary(points, 5, 1);
  for (int i = 0; i < 20; ++i) vlads.push_back(vladOf(points.rowRange(20 * i, 20 * i + 20), words));
  const PlaceMatrix many = vladDistances(vlads, vlads);
  for (Eigen::Index i = 0; i < 20; ++i) {
    for (Eigen::Index j = 0; j < 20; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      EXPECT_NEAR(many(i, j), cv::norm(vlads[a], vlads[b], cv::NORM_L2), 1e-7);
    }
  }
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE((vladDistances(vlads, vlads).array() == many.array()).all());
}

}  // namespace
}  // namespace sunlit::evaluate
