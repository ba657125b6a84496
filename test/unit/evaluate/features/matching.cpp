#include "sunlit/evaluate/features/matching.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "sunlit/evaluate/differences/comparer.h"
#include "sunlit/evaluate/differences/feature_difference.h"
#include "support/message_of.h"
#include "support/moody_detector.h"

namespace sunlit::evaluate {
namespace {

// One descriptor of one value a row: distances can be read off.
Features onALine(const std::vector<float>& places) {
  Features features;
  features.descriptors = cv::Mat(static_cast<int>(places.size()), 1, CV_32F);
  for (std::size_t i = 0; i < places.size(); ++i)
    features.descriptors.at<float>(static_cast<int>(i)) = places[i];
  features.key_points.resize(places.size());
  return features;
}

void expectAsOpenCv(const std::vector<Neighbours>& found, const cv::Mat& query, const cv::Mat& train,
                    int norm) {
  std::vector<std::vector<cv::DMatch>> expected;
  cv::BFMatcher(norm).knnMatch(query, train, expected, 2);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].best, expected[i][0].trainIdx) << i;
    EXPECT_EQ(found[i].best_distance, expected[i][0].distance) << i;
    EXPECT_EQ(found[i].second_distance, expected[i][1].distance) << i;
  }
}

void expectAsOpenCv(const cv::Mat& a, const cv::Mat& b, int norm) {
  const BothWays found = twoNearestBothWays(a, b, norm);
  expectAsOpenCv(found.from_a, a, b, norm);
  expectAsOpenCv(found.from_b, b, a, norm);
}

TEST(FeatureDifference, FollowsFromPencilAndPaper) {
  // Queries at 0, 10, 20; trains at 1, 9, 30. Best and second: 1 and 9: match; 1 and 9: match; 10 and 11:
  // none.
  const DifferenceValue d = featureDifference(onALine({0, 10, 20}), onALine({1, 9, 30}), cv::NORM_L2, {});
  EXPECT_EQ(d.features_a, 3u);
  EXPECT_EQ(d.features_b, 3u);
  EXPECT_EQ(d.matches, 2u);
  EXPECT_EQ(d.zero_second, 0u);
  EXPECT_EQ(d.value, (4.0 - 2.0) / 4.0);  // F_total = 3 + 3 − 2
}

TEST(FeatureDifference, HasASymmetricAndAOneToOneFormOfTheSameNeighbours) {
  // As above; back: from 1 best 0, second 10: match with 0; from 9 best 10, second 0: match; 30: 20 and 10
  // are 10 and 20 away: none. Both matches are each other's.
  const DifferenceValue same = featureDifference(onALine({0, 10, 20}), onALine({1, 9, 30}), cv::NORM_L2, {});
  EXPECT_EQ(same.matches_back, 2u);
  EXPECT_EQ(same.matches_one_to_one, 2u);
  EXPECT_EQ(same.symmetric, same.value);
  EXPECT_EQ(same.one_to_one, same.value);
  // Both 0 and 2 match 1, which from there is no nearer to one than to the other: 1 against 1. From 100 the
  // nearest is 2, hardly nearer than 0.
  const DifferenceValue shared = featureDifference(onALine({0, 2}), onALine({1, 100}), cv::NORM_L2, {});
  EXPECT_EQ(shared.matches, 2u);
  EXPECT_EQ(shared.matches_back, 0u);
  EXPECT_EQ(shared.matches_one_to_one, 0u);
  EXPECT_EQ(shared.value, 0.0);
  EXPECT_EQ(shared.symmetric, 0.5);
  EXPECT_EQ(shared.one_to_one, 1.0);
}

TEST(FeatureDifference, IsBelowZeroWhereManyFeaturesShareOne) {
  // Five queries around 0, trains at 0 and 1000: each matches the first, and b has two features only.
  const Features many = onALine({-2, -1, 0.25F, 1, 2});
  const Features few = onALine({0, 1000});
  const DifferenceValue d = featureDifference(many, few, cv::NORM_L2, {});
  EXPECT_EQ(d.matches, 5u);
  EXPECT_TRUE(d.isOvermatched());
  EXPECT_EQ(d.value, (2.0 - 5.0) / 2.0);  // F_total = 5 + 2 − 5
  // Back, only 0 has a clear nearest: 0.25, four times nearer than the next.
  EXPECT_EQ(d.matches_back, 1u);
  EXPECT_EQ(d.matches_one_to_one, 1u);
  EXPECT_EQ(d.one_to_one, (6.0 - 1.0) / 6.0);
  const DifferenceValue turned = featureDifference(few, many, cv::NORM_L2, {});
  EXPECT_FALSE(turned.isOvermatched());
  EXPECT_EQ(turned.value, (6.0 - 1.0) / 6.0);
  EXPECT_EQ(d.symmetric, (d.value + turned.value) / 2.0);
  EXPECT_EQ(turned.symmetric, d.symmetric);
  EXPECT_EQ(turned.one_to_one, d.one_to_one);
}

TEST(FeatureDifference, IsStrictAtTheRatioUnlessInclusive) {
  const Features query = onALine({0});
  const Features train = onALine({1, -2});  // best 1, second 2: exactly the ratio
  EXPECT_EQ(featureDifference(query, train, cv::NORM_L2, {0.5, false}).matches, 0u);
  EXPECT_EQ(featureDifference(query, train, cv::NORM_L2, {0.5, true}).matches, 1u);
}

TEST(FeatureDifference, CountsTwinsAndFindsThemEqualOnlyWhenInclusive) {
  const Features twins = onALine({5, 5, 100});
  const DifferenceValue strict = featureDifference(twins, twins, cv::NORM_L2, {0.5, false});
  EXPECT_EQ(strict.zero_second, 2u);
  EXPECT_EQ(strict.matches, 1u);
  EXPECT_EQ(strict.value, (5.0 - 1.0) / 5.0);
  const DifferenceValue inclusive = featureDifference(twins, twins, cv::NORM_L2, {0.5, true});
  EXPECT_EQ(inclusive.matches, 3u);
  EXPECT_EQ(inclusive.value, 0.0);
}

TEST(FeatureDifference, IsUndefinedWithoutAnyFeature) {
  EXPECT_TRUE(std::isnan(featureDifference({}, {}, cv::NORM_L2, {}).value));
}

TEST(FeatureDifference, IsOneWhereNothingCanMatch) {
  const Features none;
  const Features one = onALine({1});
  const Features three = onALine({1, 2, 3});
  EXPECT_EQ(featureDifference(three, none, cv::NORM_L2, {}).value, 1.0);
  EXPECT_EQ(featureDifference(none, three, cv::NORM_L2, {}).value, 1.0);
  // A single train descriptor has no second best to compare with, however near it is.
  EXPECT_EQ(featureDifference(three, one, cv::NORM_L2, {}).value, 1.0);
  EXPECT_EQ(featureDifference(three, one, cv::NORM_L2, {0.5, true}).value, 1.0);
}

TEST(TwoNearest, AreThoseOfOpenCvForBytes) {
  cv::RNG generator(1);
  for (const int width : {1, 31, 64, 128}) {
    cv::Mat query(70, width, CV_8U);
    cv::Mat train(333, width, CV_8U);
    generator.fill(query, cv::RNG::UNIFORM, 0, 256);
    generator.fill(train, cv::RNG::UNIFORM, 0, 256);
    query.row(0).copyTo(train.row(200));
    query.row(0).copyTo(train.row(100));  // twins: the first counts
    expectAsOpenCv(query, train, cv::NORM_L2);
    expectAsOpenCv(query, train, cv::NORM_HAMMING);
    expectAsOpenCv(query, train, cv::NORM_HAMMING2);
  }
}

TEST(TwoNearest, AreThoseOfOpenCvForFloatsThatNearlyTie) {
  cv::RNG generator(2);
  cv::Mat query(150, 64, CV_32F);
  generator.fill(query, cv::RNG::NORMAL, 0.0, 1.0);
  for (int i = 0; i < query.rows; ++i) cv::normalize(query.row(i), query.row(i));
  // Each query six times, moved by noise near the resolution of a float, so that order hangs on the last
  // bits.
  cv::Mat train(6 * query.rows, 64, CV_32F);
  for (int i = 0; i < train.rows; ++i) {
    cv::Mat noise(1, 64, CV_32F);
    generator.fill(noise, cv::RNG::NORMAL, 0.0, 1e-7);
    cv::Mat(query.row(i % query.rows) + noise).copyTo(train.row(i));
  }
  expectAsOpenCv(query, train, cv::NORM_L2);
  // The same far from unit length, and all zero.
  expectAsOpenCv(query * 1e4, train * 1e4, cv::NORM_L2);
  expectAsOpenCv(cv::Mat::zeros(3, 64, CV_32F), cv::Mat::zeros(4, 64, CV_32F), cv::NORM_L2);
}

TEST(TwoNearest, AreThoseOfOpenCvWhereDifferentSquaresHaveOneRoundedRoot) {
  // Bytes as far apart as can be: squares of over eight million, of which neighbours often share a root in
  // single precision. The farther rows come first.
  cv::Mat queries(40, 128, CV_8U, cv::Scalar(0));
  for (int i = 0; i < queries.rows; ++i) queries.at<uchar>(i, 0) = static_cast<uchar>(i);
  cv::Mat train(9, 128, CV_8U, cv::Scalar(255));
  for (int j = 0; j < train.rows; ++j) {
    train.at<uchar>(j, 1) = static_cast<uchar>((8 - j) / 3);
    train.at<uchar>(j, 2) = static_cast<uchar>((8 - j) % 3);
  }
  expectAsOpenCv(queries, train, cv::NORM_L2);
  expectAsOpenCv(train, queries, cv::NORM_L2);
  const std::vector<Neighbours> found = twoNearestBothWays(queries, train, cv::NORM_L2).from_a;
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const Neighbours& n) {
    return n.best != 8 && n.best_distance == n.second_distance;  // row 8 has the least square
  }));
}

TEST(TwoNearest, RefuseDescriptorsOfDifferentKinds) {
  EXPECT_THROW(twoNearestBothWays(cv::Mat::zeros(2, 32, CV_8U), cv::Mat::zeros(2, 64, CV_8U), cv::NORM_L2),
               std::invalid_argument);
}

struct Reference {
  std::string detector;
  int other;
  std::uint32_t features_a, features_b, matches;
  double forward, reverse;
};

class Leuven : public ::testing::Test {
 protected:
  void SetUp() override {
    if (grey(1).empty()) GTEST_SKIP() << "needs " << folder_;
  }
  cv::Mat rgb(int i) const {
    cv::Mat image = cv::imread(folder_ + "img" + std::to_string(i) + ".ppm");
    if (!image.empty()) cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
    return image;
  }
  cv::Mat grey(int i) const {
    const cv::Mat image = rgb(i);
    return image.empty() ? image : makePicture(image).grey;
  }
  std::string folder_ = std::string(SUNLIT_SHARED_DIR) + "/data/leuven/";
};

// ../shared/data/README.md: OpenCV 4.6.0's detectors and brute force matcher, ratio 0.5, strict.
TEST_F(Leuven, GivesTheReferenceCounts) {
  const std::vector<Reference> table = {
      {"sift", 2, 2460, 2114, 953, 0.7368, 0.7361},   {"sift", 6, 2460, 1155, 247, 0.9267, 0.9317},
      {"orb", 2, 500, 500, 113, 0.8726, 0.8914},      {"orb", 6, 500, 500, 21, 0.9785, 0.9827},
      {"brisk", 2, 4618, 3517, 1092, 0.8450, 0.8515}, {"brisk", 6, 4618, 1344, 255, 0.9553, 0.9620}};
  const double half_a_digit = 0.5e-4;  // the reference has four digits
  for (const Reference& r : table) {
#ifndef SUNLIT_SIFT
    if (r.detector == "sift") continue;
#endif
    const std::unique_ptr<Detector> detector = makeDetector(r.detector);
    const Features a = detectFeatures(*detector, Picture{{}, grey(1)});
    const Features b = detectFeatures(*detector, Picture{{}, grey(r.other)});
    const int norm = detector->norm();
    const DifferenceValue d = featureDifference(a, b, norm, {});
    EXPECT_EQ(d.features_a, r.features_a) << r.detector;
    EXPECT_EQ(d.features_b, r.features_b) << r.detector;
    EXPECT_EQ(d.matches, r.matches) << r.detector;
    EXPECT_NEAR(d.value, r.forward, half_a_digit) << r.detector;
    const DifferenceValue turned = featureDifference(b, a, norm, {});
    EXPECT_NEAR(turned.value, r.reverse, half_a_digit) << r.detector;
    EXPECT_EQ(d.matches_back, turned.matches) << r.detector;
    EXPECT_EQ(d.symmetric, (d.value + turned.value) / 2.0) << r.detector;
    EXPECT_EQ(d.one_to_one, turned.one_to_one) << r.detector;
    EXPECT_LE(d.matches_one_to_one, std::min(d.matches, d.matches_back)) << r.detector;
  }
}

TEST_F(Leuven, IsMatchedAsOpenCvDoes) {
  for (const std::string& type : readyDetectorTypes()) {
    SCOPED_TRACE(type);
    const std::unique_ptr<Detector> detector = makeDetector(type);
    expectAsOpenCv(detectFeatures(*detector, Picture{{}, grey(1)}).descriptors,
                   detectFeatures(*detector, Picture{{}, grey(6)}).descriptors, detector->norm());
  }
}

TEST_F(Leuven, SelfTestIsExactlyZeroWhenInclusive) {
  ComparerOptions options;
  options.ratio_test.inclusive = true;
  const auto values = Comparer(options).compare({rgb(3), rgb(3)}, {{0, 1}});
  for (std::size_t d = 0; d < values[0].size(); ++d) {
    EXPECT_EQ(values[0][d].value, 0.0) << options.differences[d];
  }
}

// The paper's strict rule leaves a residue, and twins explain all of it.
TEST_F(Leuven, SelfTestResidueIsTheTwins) {
  const auto values = Comparer({}).compare({rgb(3), rgb(3)}, {{0, 1}});
  for (const DifferenceValue& value : values[0]) {
    if (value.features_a > 0) {
      EXPECT_EQ(value.matches + value.zero_second, value.features_a);
    }
  }
}

TEST_F(Leuven, GivesTheSameBitsForAnyNumberOfThreads) {
  const std::vector<cv::Mat> images = {rgb(1), rgb(2), rgb(6)};
  const std::vector<ImagePair> pairs = {{0, 1}, {0, 2}, {1, 2}};
  const Comparer comparer({});
  const auto expected = comparer.compare(images, pairs);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  cv::setNumThreads(1);
  const auto alone = comparer.compare(images, pairs);
  cv::setNumThreads(-1);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    for (std::size_t d = 0; d < expected[p].size(); ++d) {
      EXPECT_EQ(alone[p][d].value, expected[p][d].value);
      EXPECT_EQ(alone[p][d].matches, expected[p][d].matches);
      EXPECT_EQ(alone[p][d].features_b, expected[p][d].features_b);
    }
  }
}

TEST(Comparer, RefusesOptionsOutOfRangeByName) {
  const auto messageFor = [](const ComparerOptions& options) {
    return messageOf([&] { const Comparer comparer(options); });
  };
  ComparerOptions options;
  options.ratio_test.ratio = 1.5;
  EXPECT_NE(messageFor(options).find("ratio is 1.5"), std::string::npos);
  options = {};
  options.differences = {"orb", "orb"};
  EXPECT_EQ(
      messageFor(options).rfind("differences is [orb, orb], but must be a list of some of boolean_rgb", 0),
      0u);
  options.differences = {};
  EXPECT_EQ(messageFor(options).rfind("differences is [], but must be", 0), 0u);
  options.differences = {"none"};
  EXPECT_EQ(messageFor(options).rfind("differences is [none], but must be", 0), 0u);
}

struct Kind {
  int norm;
  int type;
};

// 98,000 key points of BRISK against as many take half a minute: whoever waits may not wait for that.
TEST(Matching, StopsBetweenBlocksOfRows) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  constexpr int kRows = 1000;
  constexpr int kAtMostAtOnce = 64;
  constexpr int kLast = 3;
  for (const Kind& kind : {Kind{cv::NORM_L2, CV_8U}, Kind{cv::NORM_L2, CV_32F}, Kind{cv::NORM_HAMMING, CV_8U},
                           Kind{cv::NORM_HAMMING2, CV_8U}}) {
    cv::Mat rows(kRows, 32, kind.type);
    cv::RNG(7).fill(rows, cv::RNG::UNIFORM, 0, 255);
    int asked = 0;
    twoNearestBothWays(rows, rows, kind.norm, StopToken([&] { return ++asked < 0; }));
    EXPECT_GE(asked, kRows / kAtMostAtOnce) << kind.norm << " " << kind.type;
    asked = 0;
    const StopToken stop([&] { return ++asked >= kLast; });
    EXPECT_THROW(twoNearestBothWays(rows, rows, kind.norm, stop), Stopped) << kind.norm << " " << kind.type;
    EXPECT_EQ(asked, kLast) << kind.norm << " " << kind.type;  // nothing more was begun
  }
}

TEST(Comparer, RefusesParametersOfDetectorsOutOfRangeByName) {
  const auto messageFor = [](const std::string& key, double value) {
    ComparerOptions options;
    return messageOf([&] { fieldOf(fieldsOf(options), key).set(value, key); });
  };
  std::map<std::string, double> bad = {{"features/brisk/threshold", 0}, {"features/orb/wta_k", 5}};
#ifdef SUNLIT_SURF
  bad.insert({{"features/surf/n_octaves", 9},
              {"features/surf/n_octave_layers", 0},
              {"features/surf/hessian_threshold", std::nan("")}});
#endif
  for (const auto& [key, value] : bad)
    EXPECT_EQ(messageFor(key, value).rfind(key + " is " + textOf(value) + ", but must be", 0), 0u) << key;
}

// Share of pixels that are brighter than a bound in just one of two images.
class AcrossABound : public Difference {
 public:
  std::unique_ptr<Difference> clone() const override { return std::make_unique<AcrossABound>(*this); }
  std::vector<Field> fields() override { return {{"bound", &bound_, "grey levels", {0, 255}, ""}}; }
  DifferenceValue between(const View& a, const View& b, const Matching&, const StopToken&) const override {
    const int across = cv::countNonZero((a.picture.grey > bound_) != (b.picture.grey > bound_));
    return sameBothWays(across / static_cast<double>(a.picture.grey.total()));
  }

 private:
  int bound_ = 100;
};

TEST(Comparer, TakesADifferenceOfOnesOwnWithItsOptions) {
  ComparerOptions options;
  options.known.add("across", std::make_unique<AcrossABound>());
  options.differences = {"boolean_grey", "across"};
  cv::Mat dark(1, 4, CV_8UC3, cv::Scalar::all(0));
  cv::Mat bright = dark.clone();
  bright.at<cv::Vec3b>(0, 0) = {60, 60, 60};
  bright.at<cv::Vec3b>(0, 1) = {120, 120, 120};
  const auto valueOf = [&] { return Comparer(options).compare({dark, bright}, {{0, 1}})[0][1].value; };
  EXPECT_EQ(valueOf(), 1.0 / 4.0);
  const ComparerOptions before = options;
  fieldOf(fieldsOf(options), "pixels/across/bound").set(50, "bound");
  EXPECT_EQ(valueOf(), 2.0 / 4.0);
  options = before;  // copies have options of their own
  EXPECT_EQ(valueOf(), 1.0 / 4.0);
  EXPECT_THROW(options.known.add("across", std::make_unique<AcrossABound>()), std::invalid_argument);
}

// A detector costs seconds, and its inner loops must not be cut short where another difference fails.
TEST(Comparer, ThrowsWhatADifferenceThrowsOnceTheOthersAreDone) {
  ComparerOptions options;
  options.differences = {"brisk", "euclidean_rgb", "orb"};
  const cv::Mat narrow(40, 30, CV_8UC3, cv::Scalar::all(9));
  const cv::Mat wide(40, 50, CV_8UC3, cv::Scalar::all(9));
  const Comparer comparer(options);
  EXPECT_NE(messageOf([&] {
              comparer.compare({narrow, wide}, {{0, 1}});
            }).find("30×40 and 50×40 px"),
            std::string::npos);
}

/// Throws its name, after a while.
class Throws : public Difference {
 public:
  explicit Throws(const char* name, int wait_ms) : name_(name), wait_ms_(wait_ms) {}
  std::unique_ptr<Difference> clone() const override { return std::make_unique<Throws>(*this); }
  std::vector<Field> fields() override { return {}; }
  DifferenceValue between(const View&, const View&, const Matching&, const StopToken&) const override {
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms_));
    throw std::runtime_error(name_);
  }

 private:
  const char* name_;
  int wait_ms_;
};

TEST(Comparer, NamesTheFaultOfTheFirstDifferenceWhicheverIsQuicker) {
  ComparerOptions options;
  options.known.add("slow", std::make_unique<Throws>("slow", 30));
  options.known.add("quick", std::make_unique<Throws>("quick", 0));
  options.differences = {"slow", "quick"};
  const cv::Mat picture(4, 4, CV_8UC3, cv::Scalar::all(9));
  const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
  EXPECT_EQ(messageOf<std::runtime_error>([&] {
              Comparer(options).compare({picture, picture}, {{0, 1}});
            }),
            "slow");
}

TEST(Comparer, FailsThePairsOfAPictureThatADetectorThrowsAtAndNoOther) {
  ComparerOptions options;
  options.known.add("moody", makeFeatureDifference(moodyDetector()));
  options.differences = {"boolean_rgb", "moody"};
  const cv::Mat dark(60, 80, CV_8UC3, cv::Scalar::all(9)), bright(60, 80, CV_8UC3, cv::Scalar::all(99));
  std::vector<std::size_t> found, matched;
  std::mutex mutex;
  CompareVisits visits;
  visits.found = [&](const Found& one) {
    const std::lock_guard<std::mutex> lock(mutex);
    found.push_back(one.image);
  };
  visits.matched = [&](const Matched& one) {
    const std::lock_guard<std::mutex> lock(mutex);
    matched.push_back(one.pair);
  };
  const Compared compared =
      Comparer(options).compareEach({dark, marked(dark), bright}, {{0, 1}, {0, 2}, {1, 2}}, {}, visits);
  for (const std::size_t failed : {0, 2}) {
    EXPECT_EQ(messageOf<std::runtime_error>([&] { std::rethrow_exception(compared.faults[failed]); }), kMood);
  }
  EXPECT_FALSE(compared.faults[1]);
  EXPECT_EQ(compared.values[1][0].value, 1.0);
  EXPECT_TRUE(compared.image_faults[1][1]);
  EXPECT_FALSE(compared.image_faults[0][1] || compared.image_faults[1][0] || compared.image_faults[1][2]);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(matched, std::vector<std::size_t>{1});
}

TEST(Comparer, StopsBeforeItsFirstTaskWhereItIsTooLate) {
  ComparerOptions options;
  options.differences = {"boolean_rgb"};
  const cv::Mat picture(4, 4, CV_8UC3, cv::Scalar::all(9));
  const Comparer comparer(options);
  EXPECT_THROW(comparer.compare({picture, picture}, {{0, 1}}, StopToken([] { return true; })), Stopped);
  EXPECT_NO_THROW(comparer.compare({picture, picture}, {{0, 1}}, StopToken([] { return false; })));
}

TEST(Comparer, IsDecidedByTheOptionsOfWhatIsAskedFor) {
  ComparerOptions options;
  options.differences = {"boolean_rgb", "brisk"};
  std::vector<std::string> keys;
  for (const Field& row : decidingFieldsOf(options)) keys.push_back(row.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"differences", "ratio", "inclusive", "features/brisk/threshold",
                                            "features/brisk/n_octaves", "features/brisk/pattern_scale"}));
}

}  // namespace
}  // namespace sunlit::evaluate
