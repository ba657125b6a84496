#include "sunlit/evaluate/features/detector_plugin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "support/message_of.h"

namespace sunlit::evaluate {
namespace {

/// Finds the point (x, y), described by its grey level, or breaks one rule.
class Made : public DetectorPlugin {
 public:
  explicit Made(std::string fault = "") : fault_(std::move(fault)) {}
  std::vector<Field> fields() override {
    if (fault_ == "fields") throw std::runtime_error("no parameters");
    std::vector<Field> rows = {{"x", &x_, "px", {-1e6, 1e6}, ""}, {"upside_down", &upside_down_, "", {}, ""}};
    if (fault_ == "key") rows.push_back({"clahe", &x_, "", {}, ""});
    if (fault_ == "twice") rows.push_back({"x", &x_, "", {}, ""});
    return rows;
  }
  std::vector<cv::KeyPoint> detect(const cv::Mat&) override {
    if (fault_ == "throws") throw std::runtime_error("out of ideas");
    if (fault_ == "throws lines") throw std::runtime_error("out\nof\t\x1b ideas µ");
    if (fault_ == "throws a number") throw 7;
    return {cv::KeyPoint(fault_ == "nan" ? NAN : static_cast<float>(x_), 2.0F, 1.0F)};
  }
  cv::Mat describe(const cv::Mat& grey, std::vector<cv::KeyPoint>& points) override {
    if (fault_ == "drops") points.clear();
    if (fault_ == "moves") points[0].pt.y = static_cast<float>(grey.rows);
    cv::Mat rows(fault_ == "rows" ? 2 : static_cast<int>(points.size()), 1,
                 fault_ == "type" ? CV_64F : CV_32F);
    rows = cv::Scalar(fault_ == "infinite" ? INFINITY : grey.at<unsigned char>(2, 3));
    if (upside_down_) rows = -rows;
    return rows;
  }
  int norm() const override {
    if (fault_ == "bits of numbers") return cv::NORM_HAMMING;
    return fault_ == "norm" ? cv::NORM_INF : cv::NORM_L2;
  }
  std::string version() const override { return fault_ == "new" ? "" : "2"; }

 private:
  std::string fault_;
  double x_ = 3.0;
  bool upside_down_ = false;
};

std::unique_ptr<Detector> detectorWith(const std::string& fault) {
  return makePluginDetector("mine/Made", [fault] { return std::make_shared<Made>(fault); });
}

Picture picture() {
  cv::Mat grey = cv::Mat::zeros(5, 8, CV_8U);
  grey.at<unsigned char>(2, 3) = 9;
  return {{}, grey};
}

TEST(DetectorPlugin, FindsWithItsParameters) {
  const auto detector = detectorWith("");
  EXPECT_EQ(detector->norm(), cv::NORM_L2);
  const Features usual = detectFeatures(*detector, picture());
  ASSERT_EQ(usual.key_points.size(), 1u);
  EXPECT_EQ(usual.key_points[0].pt, cv::Point2f(3, 2));
  EXPECT_EQ(usual.descriptors.at<float>(0), 9.0F);
  fieldOf(detector->fields(), "x").set(5, "");
  fieldOf(detector->fields(), "upside_down").set(true, "");
  const Features other = detectFeatures(*detector->clone(), picture());
  EXPECT_EQ(other.key_points[0].pt, cv::Point2f(5, 2));
  EXPECT_EQ(other.descriptors.at<float>(0), -9.0F);
  EXPECT_EQ(detectFeatures(*detectorWith("drops"), picture()).key_points.size(), 0u);
}

TEST(DetectorPlugin, IsKeptUnderNameVersionAndParametersOnlyIfItHasAVersion) {
  EXPECT_EQ(detectorWith("new")->identity(), "");
  const auto detector = detectorWith("");
  const std::string usual = detector->identity();
  EXPECT_EQ(usual.rfind("mine/Made 2\n", 0), 0u);
  fieldOf(detector->fields(), "x").set(5, "");
  EXPECT_NE(detector->identity(), usual);
}

TEST(DetectorPlugin, IsRefusedByOneLineWhereItBreaksARule) {
  const auto says = [](const std::string& fault, double x = 3.0) {
    const auto detector = detectorWith(fault);
    fieldOf(detector->fields(), "x").set(x, "");
    return messageOf<std::runtime_error>([&] { detectFeatures(*detector, picture()); });
  };
  const std::string who = "detector mine/Made: ";
  const std::string outside = "), outside the picture of 8×5 px";
  EXPECT_EQ(says("throws"), who + "out of ideas");
  EXPECT_EQ(says("throws lines"), who + "out of   ideas µ") << "in one line";
  EXPECT_EQ(says("throws a number"), who + "throws what is no std::exception");
  EXPECT_EQ(says("nan"), who + "gives the key point (nan, 2" + outside);
  EXPECT_EQ(says("", 7.5), who + "gives the key point (7.5, 2" + outside);
  EXPECT_EQ(says("", -0.6), who + "gives the key point (-0.6, 2" + outside);
  EXPECT_EQ(says("moves"), who + "gives the key point (3, 5" + outside);
  EXPECT_EQ(says("rows"), who + "gives 2 descriptors of 1 key points");
  EXPECT_EQ(says("type"),
            who + "gives descriptors of OpenCV type CV_64FC1, but must give CV_8UC1 or CV_32FC1");
  EXPECT_EQ(says("bits of numbers"),
            who + "gives descriptors of OpenCV type CV_32FC1, but must give CV_8UC1");
  EXPECT_EQ(says("infinite"), who + "gives descriptors that are no finite numbers");
}

TEST(DetectorPlugin, IsRefusedAtOnceForItsNormAndParameters) {
  const auto says = [](const std::string& fault) { return messageOf([&] { detectorWith(fault); }); };
  EXPECT_EQ(says("fields"), "detector mine/Made: no parameters");
  EXPECT_NE(says("norm").find("detector mine/Made: its norm is 1, but must be cv::NORM_L1"),
            std::string::npos);
  EXPECT_NE(says("key").find("detector mine/Made: a parameter is \"clahe\", but must be"), std::string::npos);
  EXPECT_NE(says("twice").find("detector mine/Made: a parameter is \"x\", but must be"), std::string::npos);
  EXPECT_EQ(messageOf([] {
              makePluginDetector("mine/None", []() -> std::shared_ptr<DetectorPlugin> {
                throw std::runtime_error("no such library");
              });
            }),
            "detector mine/None: no such library");
}

}  // namespace
}  // namespace sunlit::evaluate
