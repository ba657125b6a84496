#include "sunlit/evaluate/features/detector.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sunlit/evaluate/differences/comparer.h"
#include "sunlit/evaluate/differences/feature_difference.h"
#include "support/message_of.h"

namespace sunlit::evaluate {
namespace {

// Blobs and edges of several sizes.
cv::Mat madeGrey(int seed) {
  cv::Mat fine(240, 320, CV_8U);
  cv::Mat coarse(30, 40, CV_8U);
  cv::RNG generator(static_cast<std::uint64_t>(seed));
  generator.fill(fine, cv::RNG::UNIFORM, 0, 256);
  generator.fill(coarse, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(fine, fine, {}, 1.5);
  cv::resize(coarse, coarse, fine.size(), 0, 0, cv::INTER_CUBIC);
  cv::Mat both;
  cv::addWeighted(fine, 1.0, coarse, 0.7, -60.0, both);
  return both;
}

Features featuresOf(const cv::Ptr<cv::Feature2D>& worker, const cv::Mat& grey) {
  Features features;
  worker->detectAndCompute(grey, cv::noArray(), features.key_points, features.descriptors);
  return features;
}

void expectSame(const Features& found, const Features& expected) {
  ASSERT_EQ(found.key_points.size(), expected.key_points.size());
  ASSERT_GT(found.key_points.size(), 20u);
  for (std::size_t i = 0; i < found.key_points.size(); ++i) {
    const cv::KeyPoint& a = found.key_points[i];
    const cv::KeyPoint& b = expected.key_points[i];
    ASSERT_TRUE(a.pt == b.pt && a.size == b.size && a.angle == b.angle && a.response == b.response) << i;
  }
  ASSERT_EQ(found.descriptors.size(), expected.descriptors.size());
  cv::Mat a;
  cv::Mat b;
  found.descriptors.convertTo(a, CV_64F);
  expected.descriptors.convertTo(b, CV_64F);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
}

TEST(Detectors, FindByDefaultWhatOpenCvFinds) {
  const cv::Mat grey = madeGrey(1);
  const std::map<std::string, cv::Ptr<cv::Feature2D>> direct = {
#ifdef SUNLIT_SIFT
      {"sift", cv::SIFT::create()},
#endif
      {"orb", cv::ORB::create()},
      {"brisk", cv::BRISK::create()},
      {"akaze", cv::AKAZE::create()},
      {"kaze", cv::KAZE::create()}};
  for (const auto& [type, worker] : direct) {
    SCOPED_TRACE(type);
    const std::unique_ptr<Detector> detector = makeDetector(type);
    expectSame(detectFeatures(*detector, Picture{{}, grey}), featuresOf(worker, grey));
    EXPECT_EQ(detector->norm(), worker->defaultNorm());
  }
}

std::unique_ptr<Detector> changed(const std::string& type, const std::map<std::string, std::string>& values) {
  std::unique_ptr<Detector> detector = makeDetector(type);
  const std::vector<Field> rows = detector->fields();
  EXPECT_EQ(rows.size(), values.size()) << "every parameter is to differ";
  for (const auto& [key, value] : values) {
    const Field& row = fieldOf(rows, key);
    EXPECT_NE(row.text(), value) << key;
    row.setText(value, key);
  }
  return detector->clone();
}

TEST(Detectors, PassEveryParameterOnToOpenCv) {
  const cv::Mat grey = madeGrey(2);
  const auto akaze = changed("akaze", {{"descriptor_type", "mldb_upright"},
                                       {"descriptor_size", "200"},
                                       {"descriptor_channels", "2"},
                                       {"threshold", "0.0005"},
                                       {"n_octaves", "2"},
                                       {"n_octave_layers", "3"},
                                       {"diffusivity", "weickert"}});
  expectSame(detectFeatures(*akaze, Picture{{}, grey}),
             featuresOf(cv::AKAZE::create(cv::AKAZE::DESCRIPTOR_MLDB_UPRIGHT, 200, 2, 0.0005F, 2, 3,
                                          cv::KAZE::DIFF_WEICKERT),
                        grey));
  const auto kaze = changed("kaze", {{"extended", "true"},
                                     {"upright", "true"},
                                     {"threshold", "0.0005"},
                                     {"n_octaves", "2"},
                                     {"n_octave_layers", "3"},
                                     {"diffusivity", "charbonnier"}});
  expectSame(detectFeatures(*kaze, Picture{{}, grey}),
             featuresOf(cv::KAZE::create(true, true, 0.0005F, 2, 3, cv::KAZE::DIFF_CHARBONNIER), grey));
}

TEST(Detectors, CompareNumbersOfAkazeByLengthAndItsBitsByCount) {
  const std::map<std::string, int> norms = {{"kaze_upright", cv::NORM_L2},
                                            {"kaze", cv::NORM_L2},
                                            {"mldb_upright", cv::NORM_HAMMING},
                                            {"mldb", cv::NORM_HAMMING}};
  for (const auto& [word, norm] : norms) {
    const std::unique_ptr<Detector> akaze = makeDetector("akaze");
    fieldOf(akaze->fields(), "descriptor_type").setText(word, word);
    EXPECT_EQ(akaze->norm(), norm) << word;
    EXPECT_EQ(akaze->make()->defaultNorm(), norm) << word;
  }
}

TEST(Detectors, RefuseMoreBitsThanAkazeHas) {
  const std::unique_ptr<Detector> akaze = makeDetector("akaze");
  fieldOf(akaze->fields(), "descriptor_size").set(324, "");
  akaze->make();
  fieldOf(akaze->fields(), "descriptor_channels").set(1, "");
  EXPECT_EQ(messageOf([&] { akaze->make(); }),
            "descriptor_size of AKAZE is 324, but must be from 0 to 162 bit");
}

#ifdef SUNLIT_SIFT
TEST(RootSift, IsTheRootOfOpenCvsSiftInTheL1Norm) {
  const cv::Mat grey = madeGrey(3);
  const Features sift = featuresOf(cv::SIFT::create(), grey);
  const std::unique_ptr<Detector> detector = makeDetector("rootsift");
  const Features found = detectFeatures(*detector, Picture{{}, grey});
  EXPECT_EQ(detector->norm(), cv::NORM_L2);
  ASSERT_EQ(found.descriptors.size(), sift.descriptors.size());
  ASSERT_EQ(found.descriptors.type(), CV_32F);
  ASSERT_GT(found.descriptors.rows, 100);
  for (int i = 0; i < sift.descriptors.rows; ++i) {
    cv::Mat expected;
    sift.descriptors.row(i).convertTo(expected, CV_64F);
    expected /= cv::norm(expected, cv::NORM_L1);
    cv::sqrt(expected, expected);
    cv::Mat row;
    found.descriptors.row(i).convertTo(row, CV_64F);
    // One division and one root in single precision, of numbers below 1.
    EXPECT_LT(cv::norm(row, expected, cv::NORM_INF), 1.2e-7);
    EXPECT_NEAR(cv::norm(row, cv::NORM_L2), 1.0, 1e-6);
  }
}

TEST(RootSift, HasTheParametersAndKeyPointsOfSift) {
  const cv::Mat grey = madeGrey(3);
  const std::unique_ptr<Detector> root = makeDetector("rootsift");
  const std::unique_ptr<Detector> sift = makeDetector("sift");
  const std::vector<Field> rows = root->fields();
  for (const Field& row : sift->fields()) EXPECT_EQ(fieldOf(rows, row.key).text(), row.text());
  fieldOf(rows, "contrast_threshold").set(0.08, "");
  fieldOf(sift->fields(), "contrast_threshold").set(0.08, "");
  const Features found = detectFeatures(*root->clone(), Picture{{}, grey});
  const Features expected = detectFeatures(*sift, Picture{{}, grey});
  ASSERT_EQ(found.key_points.size(), expected.key_points.size());
  for (std::size_t i = 0; i < found.key_points.size(); ++i)
    EXPECT_EQ(found.key_points[i].pt, expected.key_points[i].pt);
  // A mask passes through, and key points alone can be had.
  std::vector<cv::KeyPoint> none;
  root->make()->detectAndCompute(grey, cv::Mat::zeros(grey.size(), CV_8U), none, cv::noArray());
  EXPECT_TRUE(none.empty());
}
#endif

TEST(Detectors, FindTheSameForAnyNumberOfThreads) {
  for (const std::string& type : readyDetectorTypes()) {
    SCOPED_TRACE(type);
    const std::unique_ptr<Detector> detector = makeDetector(type);
    for (const Field& row : detector->fields()) {
      if (row.key == "descriptor_size") row.set(200, "");  // bits are then drawn at random
    }
    ComparerOptions options;
    options.known.add("asked_for", makeFeatureDifference(detector->clone()));
    options.differences = {"asked_for", type};
    std::vector<cv::Mat> images(4);
    for (int i = 0; i < 4; ++i) cv::cvtColor(madeGrey(7), images[i], cv::COLOR_GRAY2RGB);
    images[3] = images[3] / 2 + cv::Scalar::all(30);
    const std::vector<ImagePair> pairs = {{0, 1}, {0, 2}, {0, 3}};
    const auto together = Comparer(options).compare(images, pairs);
    Features many = detectFeatures(*detector, Picture{{}, madeGrey(7)});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    cv::setNumThreads(1);
    const auto alone = Comparer(options).compare(images, pairs);
    const Features few = detectFeatures(*detector, Picture{{}, madeGrey(7)});
    cv::setNumThreads(-1);
    expectSame(many, few);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      for (std::size_t d = 0; d < 2; ++d) {
        EXPECT_EQ(together[p][d].value, alone[p][d].value);
        EXPECT_EQ(together[p][d].matches, alone[p][d].matches);
        EXPECT_EQ(together[p][d].features_a, few.key_points.size()) << "of " << d;
      }
    }
  }
}

TEST(Detectors, SayWhichPictureIsTooSmall) {
  const auto said = messageOf<std::runtime_error>([] {
    detectFeatures(*makeDetector("brisk"), Picture{{}, cv::Mat(7, 5, CV_8U, cv::Scalar(9))});
  });
  EXPECT_EQ(said.rfind("Feature2D.BRISK finds no features in a picture of 5×7 px: ", 0), 0u) << said;
}

TEST(Detectors, StandSeveralTimesUnderNamesOfTheirOwn) {
  ComparerOptions options;
  options.known.add("brisk_loose", makeFeatureDifference(makeOwnDetector({"brisk", ""})));
  options.differences = {"brisk", "brisk_loose"};
  fieldOf(fieldsOf(options), "features/brisk_loose/threshold").set(10, "");
  EXPECT_EQ(fieldOf(decidingFieldsOf(options), "features/brisk_loose/type").text(), "brisk");
  cv::Mat image;
  cv::cvtColor(madeGrey(4) / 2, image, cv::COLOR_GRAY2RGB);
  const auto values = Comparer(options).compare({image, image}, {{0, 1}})[0];
  const cv::Mat grey = makePicture(image).grey;
  EXPECT_EQ(values[0].features_a, featuresOf(cv::BRISK::create(), grey).key_points.size());
  EXPECT_EQ(values[1].features_a, featuresOf(cv::BRISK::create(10), grey).key_points.size());
  EXPECT_LT(values[0].features_a, values[1].features_a);
}

TEST(Detectors, RefuseNamesThatAreTakenOrNoWords) {
  Differences known;
  for (const std::string name : {"orb", "boolean_rgb", "", "orb-2", "2orb", "a/b", "a b"}) {
    EXPECT_NE(messageOf([&] {
                known.add(name, makeFeatureDifference(makeOwnDetector({"orb", ""})));
              }).find("the name of a difference is \"" + name + "\", but must be"),
              std::string::npos)
        << name;
  }
  const std::string misspelt = messageOf([] { makeDetector("sfit"); });
#ifdef SUNLIT_SIFT
  EXPECT_NE(misspelt.find("one of [sift, "), std::string::npos) << misspelt;
#endif
  EXPECT_NE(misspelt.find(" orb, brisk, "), std::string::npos) << misspelt;
}

}  // namespace
}  // namespace sunlit::evaluate
