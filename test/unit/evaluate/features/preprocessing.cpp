#include "sunlit/evaluate/features/preprocessing.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "sunlit/evaluate/differences/comparer.h"
#include "sunlit/evaluate/differences/feature_difference.h"
#include "sunlit/evaluate/features/detector.h"
#include "support/message_of.h"

namespace sunlit::evaluate {
namespace {

Picture inGrey(const cv::Mat& grey) {
  Picture picture;
  picture.grey = grey;
  cv::cvtColor(grey, picture.rgb, cv::COLOR_GRAY2RGB);
  return picture;
}

Picture ofColour(const cv::Vec3b& rgb) {
  return makePicture(cv::Mat(1, 1, CV_8UC3, cv::Scalar(rgb[0], rgb[1], rgb[2])));
}

Picture noise(cv::Size size) {
  cv::Mat rgb(size, CV_8UC3);
  cv::RNG(3).fill(rgb, cv::RNG::UNIFORM, 0, 256);
  return makePicture(rgb);
}

void set(Preprocessing& preprocessing, const std::string& key, const Field::Value& value) {
  fieldOf(preprocessing.fields(), key).set(value, key);
}

TEST(Preprocessing, ByGammaRaisesGreyLevelsToAPower) {
  const auto gamma = makePreprocessing("gamma");
  const Picture picture = inGrey((cv::Mat_<uchar>(1, 4) << 0, 64, 128, 255));
  // 255 √(64/255) = 127.75, 255 √(128/255) = 180.67.
  EXPECT_EQ(cv::countNonZero(gamma->of(picture) != (cv::Mat_<uchar>(1, 4) << 0, 128, 181, 255)), 0);
  set(*gamma, "exponent", 2.0);  // 64²/255 = 16.06, 128²/255 = 64.25
  EXPECT_EQ(cv::countNonZero(gamma->of(picture) != (cv::Mat_<uchar>(1, 4) << 0, 16, 64, 255)), 0);
  set(*gamma, "exponent", 1.0);
  EXPECT_EQ(cv::countNonZero(gamma->of(picture) != picture.grey), 0);
}

TEST(Preprocessing, ByClaheWithOneTileAndWithoutALimitEqualisesTheHistogram) {
  const auto clahe = makePreprocessing("clahe");
  set(*clahe, "tiles", 1);
  set(*clahe, "clip_limit", 256.0);
  // Two, three and four of four pixels are as dark: 127.5, 191.25 and 255.
  const cv::Mat found = clahe->of(inGrey((cv::Mat_<uchar>(2, 2) << 10, 50, 200, 10)));
  EXPECT_EQ(cv::countNonZero(found != (cv::Mat_<uchar>(2, 2) << 128, 191, 255, 128)), 0);
}

TEST(Preprocessing, ByClaheWithItsLowestLimitLeavesAFlatPictureAsItIs) {
  const auto clahe = makePreprocessing("clahe");
  set(*clahe, "tiles", 1);
  const Picture flat = inGrey(cv::Mat(16, 16, CV_8U, cv::Scalar(100)));
  set(*clahe, "clip_limit", 256.0);
  EXPECT_EQ(clahe->of(flat).at<uchar>(5, 5), 255);
  // One pixel of 256 may have level 100; the others are spread over the levels from 0 on, one each. So 102 of
  // 256 are as dark, 101.6.
  set(*clahe, "clip_limit", 1.0);
  EXPECT_EQ(clahe->of(flat).at<uchar>(5, 5), 102);
}

TEST(Preprocessing, InvariantOfIlluminationFollowsFromPencilAndPaper) {
  const auto invariant = makePreprocessing("illumination_invariant");
  const auto levelOf = [&](const cv::Vec3b& rgb) { return int{invariant->of(ofColour(rgb)).at<uchar>(0)}; };
  for (const uchar grey : {0, 1, 7, 100, 255}) EXPECT_EQ(levelOf({grey, grey, grey}), 128);
  // α = (1/549.1 − 1/611.4) / (1/464.2 − 1/611.4) = 0.35780. Code 188 is 0.50289 of the light, log −0.68738.
  EXPECT_EQ(levelOf({255, 255, 188}), 159);  // 128 + 127 · 0.35780 · 0.68738 = 159.24
  EXPECT_EQ(levelOf({188, 255, 255}), 184);  // 128 + 127 · 0.64220 · 0.68738 = 184.06
  EXPECT_EQ(levelOf({255, 188, 255}), 41);   // 128 − 127 · 0.68738 = 40.70
  EXPECT_EQ(levelOf({0, 255, 0}), 255);      // log 0 is that of code 1, and the end of the levels the end
  EXPECT_EQ(levelOf({255, 0, 255}), 0);
  // The authors' camera: 1/540 = α/470 + (1 − α)/610, α = 0.43519.
  for (const auto& [key, nm] :
       std::map<std::string, double>{{"peak_red", 610.0}, {"peak_green", 540.0}, {"peak_blue", 470.0}})
    set(*invariant, key, nm);
  EXPECT_EQ(levelOf({255, 255, 188}), 166);  // 128 + 127 · 0.43519 · 0.68738 = 165.99
}

// Where the line from D65 through a primary leaves the chromaticities of the CIE 1931 observer, of which two
// are given, 5 nm apart (CIE 015). They bend by less than 0.1 nm in between.
TEST(Preprocessing, PeaksAreTheDominantWavelengthsOfThePrimaries) {
  struct Case {
    const char* key;
    cv::Vec2d primary;  // ITU-R BT.709
    double below_nm;
    cv::Vec2d below, above;
  };
  const cv::Vec2d white(0.3127, 0.3290);
  const auto invariant = makePreprocessing("illumination_invariant");
  for (const Case& one : {Case{"peak_red", {0.64, 0.33}, 610.0, {0.66576, 0.33401}, {0.68008, 0.31975}},
                          Case{"peak_green", {0.30, 0.60}, 545.0, {0.26578, 0.72432}, {0.30160, 0.69231}},
                          Case{"peak_blue", {0.15, 0.06}, 460.0, {0.14396, 0.02970}, {0.13550, 0.03988}}}) {
    const auto across = [](const cv::Vec2d& a, const cv::Vec2d& b) { return a[0] * b[1] - a[1] * b[0]; };
    const cv::Vec2d ray = one.primary - white;
    const double from = across(ray, one.below - white);
    const double to = across(ray, one.above - white);
    const double wavelength_nm = one.below_nm + 5.0 * from / (from - to);
    EXPECT_NEAR(std::get<double>(fieldOf(invariant->fields(), one.key).value()), wavelength_nm, 0.1)
        << one.key;
  }
}

// Planck's law but for its first constant; λ in nm, T in K.
double blackBody(double wavelength_nm, double temperature_K) {
  constexpr double kSecondConstant_nm_K = 1.438777e7;  // CODATA 2018
  return 1e15 / std::pow(wavelength_nm, 5) / std::expm1(kSecondConstant_nm_K / wavelength_nm / temperature_K);
}

uchar codeOf(double linear) {  // IEC 61966-2-1
  const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<uchar>(std::lround(255.0 * encoded));
}

/// What a camera of three narrow bands, whose brightest channel is `brightest`, sees of a colour.
cv::Vec3b seen(const std::array<double, 3>& reflectance, double temperature_K, double brightest) {
  constexpr std::array<double, 3> kPeaks_nm = {611.4, 549.1, 464.2};
  std::array<double, 3> light{};
  for (std::size_t k = 0; k < 3; ++k) light[k] = reflectance[k] * blackBody(kPeaks_nm[k], temperature_K);
  const double largest = std::max({light[0], light[1], light[2]});
  cv::Vec3b codes;
  for (int k = 0; k < 3; ++k) codes[k] = codeOf(brightest * light[static_cast<std::size_t>(k)] / largest);
  return codes;
}

// Half a code moves log of linear light by 1.2 / (code + 14), from the curve's 2.4 log(code + 14.03); each
// channel counts by its share of the equation.
double levelsOfHalfACode(const cv::Vec3b& codes) {
  const double alpha = 0.358;
  const std::array<double, 3> shares = {1.0 - alpha, 1.0, alpha};
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += shares[static_cast<std::size_t>(k)] * 1.2 / (codes[k] + 14.0);
  return 127.0 * sum;
}

TEST(Preprocessing, InvariantOfIlluminationSeesAColourAlikeUnderTwoBlackBodies) {
  const auto invariant = makePreprocessing("illumination_invariant");
  const std::vector<std::array<double, 3>> colours = {
      {0.5, 0.5, 0.5}, {0.5, 0.3, 0.2}, {0.3, 0.5, 0.25}, {0.5, 0.3, 0.5}};
  std::vector<int> levels;
  for (const auto& colour : colours) {
    const cv::Vec3b lamp = seen(colour, 3000.0, 0.9), shade = seen(colour, 8000.0, 0.4);
    const Picture a = ofColour(lamp), b = ofColour(shade);
    EXPECT_GT(std::abs(a.grey.at<uchar>(0) - b.grey.at<uchar>(0)), 25);
    levels.push_back(invariant->of(a).at<uchar>(0));
    // Codes are whole, levels are; and Planck's law is off Wien's, for which it holds, by −log(1 −
    // e^(−c₂/λT)), at 8000 K 0.054, 0.038 and 0.021: 0.038 − 0.358 · 0.021 − 0.642 · 0.054 = 0.004, half a
    // level.
    const double tolerance = levelsOfHalfACode(lamp) + levelsOfHalfACode(shade) + 1.0 + 0.5;
    EXPECT_LT(tolerance, 6.0);
    EXPECT_NEAR(levels.back(), invariant->of(b).at<uchar>(0), tolerance);
  }
  // Other colours are others.
  for (std::size_t i = 0; i < levels.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(std::abs(levels[i] - levels[j]), 6) << i << " " << j;
  }
}

TEST(Preprocessing, KeepsTheSizeOfAnyPictureAndDoesNotDependOnThreads) {
  for (const std::string& name : preprocessingNames()) {
    const auto preprocessing = makePreprocessing(name);
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 5), cv::Size(64, 64), cv::Size(321, 203)}) {
      const Picture picture = noise(size);
      const cv::Mat grey = picture.grey.clone();
      const cv::Mat many = preprocessing->of(picture);
      EXPECT_EQ(many.size(), size) << name;
      EXPECT_EQ(many.type(), CV_8UC1) << name;
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      EXPECT_EQ(cv::countNonZero(preprocessing->clone()->of(picture) != many), 0) << name;
      EXPECT_EQ(cv::countNonZero(grey != picture.grey), 0) << name;  // others look at it too
    }
  }
}

TEST(Preprocessing, StandsBeforeADetectorUnderANameOfOnesOwn) {
  ComparerOptions options;
  options.known.add("brisk_clahe", makeFeatureDifference(makeOwnDetector({"brisk", "clahe"})));
  options.differences = {"brisk", "brisk_clahe"};
  const auto deciding = decidingFieldsOf(options);
  EXPECT_EQ(fieldOf(deciding, "features/brisk_clahe/type").text(), "brisk");
  EXPECT_EQ(fieldOf(deciding, "features/brisk_clahe/preprocessing").text(), "clahe");
  fieldOf(deciding, "features/brisk_clahe/clahe/clip_limit").set(5.0, "");
  cv::Mat rgb = noise({320, 240}).rgb;
  cv::GaussianBlur(rgb, rgb, {}, 1.5);
  const auto values = Comparer(options).compare({rgb, rgb}, {{0, 1}})[0];
  cv::Mat equalised;
  cv::createCLAHE(5.0, {8, 8})->apply(makePicture(rgb).grey, equalised);
  std::vector<cv::KeyPoint> expected;
  cv::BRISK::create()->detect(equalised, expected);
  EXPECT_EQ(values[1].features_a, expected.size());
  EXPECT_NE(values[0].features_a, expected.size());
}

TEST(Preprocessing, IsNamedBehindADetectorByAPlus) {
  const Picture picture = noise({64, 48});
  const auto prepared = makeDetector(DetectorKind::named("orb+gamma"));
  EXPECT_EQ(cv::countNonZero(prepared->seen(picture) != makePreprocessing("gamma")->of(picture)), 0);
  EXPECT_EQ(makeDetector(DetectorKind::named("orb"))->seen(picture).data, picture.grey.data);
  EXPECT_EQ(messageOf([] { makeDetector(DetectorKind::named("orb+gama")); }),
            "preprocessing is \"gama\", but must be one of [clahe, gamma, illumination_invariant]");
  EXPECT_NE(messageOf([] { makeDetector(DetectorKind::named("obr+gamma")); }).find("detector is \"obr\""),
            std::string::npos);
  const Preprocessings all;
  Preprocessings copy = all;
  fieldOf(copy.fields(), "gamma/exponent").set(2.0, "");
  EXPECT_NE(cv::countNonZero(copy.at("gamma").of(picture) != all.at("gamma").of(picture)), 0);
}

}  // namespace
}  // namespace sunlit::evaluate
