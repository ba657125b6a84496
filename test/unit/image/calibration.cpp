// Calibration files are read to the last digit, and refused by file, line, key, value and what is allowed.
#include "sunlit/image/calibration.h"

#include <gtest/gtest.h>

#include <fstream>
#include <tuple>

#include "support/message_of.h"
#include "support/published_lenses.h"
#include "support/temporary_folder.h"

namespace sunlit::image {
namespace {

const std::string kEuroc = SUNLIT_SOURCE_DIR "/test/support/cameras/euroc.yaml";

class CalibrationFile : public testing::Test {
 protected:
  /// What is said of EuRoC's file with `from` changed to `to`.
  std::string refusalOf(const std::string& from, const std::string& to) const {
    std::string text = contentOf(kEuroc);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return refusalOf(text.replace(at, from.size(), to));
  }
  std::string refusalOf(const std::string& text) const {
    const std::string file = folder_.file("camera.yaml");
    std::ofstream(file) << text;
    return messageOf<std::runtime_error>([&] { readCalibration(file); });
  }
  void expect(const std::string& message, const std::vector<std::string>& words) const {
    EXPECT_NE(message.find("camera.yaml:"), std::string::npos) << message;
    for (const std::string& word : words) EXPECT_NE(message.find(word), std::string::npos) << message;
  }

  const TemporaryFolder folder_;
};

TEST_F(CalibrationFile, OfEurocIsReadAsItStands) {
  const Calibration read = readCalibration(kEuroc);
  const PublishedLens euroc = eurocLens();
  EXPECT_EQ(read.name, "euroc_cam0");
  EXPECT_EQ(read.camera.width, 752);
  EXPECT_EQ(read.camera.height, 480);
  EXPECT_EQ(read.camera.fx, euroc.camera.fx);
  EXPECT_EQ(read.camera.fy, euroc.camera.fy);
  EXPECT_EQ(read.camera.cx, euroc.camera.cx);
  EXPECT_EQ(read.camera.cy, euroc.camera.cy);
  EXPECT_EQ(read.distortion.model, LensModel::kPlumbBob);
  EXPECT_EQ(read.distortion.coefficients,
            (std::vector<double>{-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0}));
  EXPECT_EQ(read.rectification[1], -0.001422739138722922);
  EXPECT_EQ(read.projection[0], 435.2046959714599);
  EXPECT_EQ(read.projection[2], 367.4517211914062);
}

TEST_F(CalibrationFile, OfAFisheyeIsReadAsItStands) {
  const Calibration read = readCalibration(SUNLIT_SOURCE_DIR "/test/support/cameras/tum_vi.yaml");
  EXPECT_EQ(read.distortion.model, LensModel::kEquidistant);
  EXPECT_EQ(read.distortion.coefficients, tumViLens().distortion.coefficients);
}

TEST_F(CalibrationFile, OfWhatOthersPublishIsReadAsItStands) {
  for (const auto& [name, published] : {std::pair<std::string, PublishedLens>{"kitti", kittiLens()},
                                        {"d435i", d435iLens()},
                                        {"rational", rationalLens()},
                                        {"omni", omniLens()}}) {
    const Calibration read = readCalibration(SUNLIT_SOURCE_DIR "/test/support/cameras/" + name + ".yaml");
    const PinholeCamera &camera = read.camera, &expected = published.camera;
    EXPECT_EQ(
        std::make_tuple(camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy),
        std::make_tuple(expected.width, expected.height, expected.fx, expected.fy, expected.cx, expected.cy))
        << name;
    EXPECT_EQ(read.distortion.model, published.distortion.model) << name;
    EXPECT_EQ(read.distortion.none(), published.distortion.none()) << name;
    if (!read.distortion.none()) {
      EXPECT_EQ(read.distortion.coefficients, published.distortion.coefficients) << name;
    }
  }
}

TEST_F(CalibrationFile, WithoutAModelIsPlumbBobAndRowsAndColumnsOfCoefficientsDoNotCount) {
  std::string text = contentOf(kEuroc);
  text.replace(text.find("distortion_model: plumb_bob\n"), 28, "");
  EXPECT_EQ(refusalOf(text), "");
  text = contentOf(kEuroc);
  text.replace(text.find("cols: 5"), 7, "cols: 4");
  EXPECT_EQ(refusalOf(text), "");
}

TEST_F(CalibrationFile, IsRefusedByItsLineAndKey) {
  expect(refusalOf("image_width: 752", "image_width: 0"), {":1:", "image_width", "is 0", "from 16 to 8192"});
  expect(refusalOf("image_width: 752", "image_width: 752.5"), {":1:", "image_width", "752.5", "whole"});
  expect(refusalOf("image_height: 480", "image_height: [480]"), {":2:", "image_height", "a number"});
  expect(refusalOf("image_height: 480", "hight: 480"), {"image_height is missing"});
  expect(refusalOf("plumb_bob", "fov"),
         {":8:", "distortion_model", "\"fov\"", "plumb_bob, rational_polynomial"});
  expect(refusalOf("[458.654,", "[-458.654,"), {"camera_matrix[0] (fx)", "-458.654", "above 0"});
  expect(refusalOf("[458.654,", "[0,"), {"camera_matrix[0] (fx)", "is 0", "above 0"});
  expect(refusalOf("[458.654,", "[.nan,"), {":7:", "camera_matrix[0]", "nan", "finite"});
  expect(refusalOf("[458.654, 0,", "[458.654, 0.5,"), {"camera_matrix[1] (skew)", "0.5", "be 0"});
  expect(refusalOf("[458.654, 0,", "[458.654,"), {"camera_matrix", "8 numbers", "9 numbers"});
  expect(refusalOf("-0.28340811,", "bent,"), {":12:", "distortion_coefficients[0]", "\"bent\"", "a number"});
  expect(refusalOf("-0.28340811, 0.07395907,", ""), {"distortion_coefficients", "3 numbers", "4 or 5"});
  expect(refusalOf("plumb_bob", "rational_polynomial"), {"5 numbers", "8, k1", "rational_polynomial"});
  expect(refusalOf("plumb_bob", "equidistant"), {"5 numbers", "4, k1", "equidistant"});
  expect(refusalOf("projection_matrix", "protection_matrix"), {"projection_matrix is missing"});
  expect(refusalOf("-0.28340811", "-0.9"), {"752 x 480", "beyond", "degrees", "plumb_bob"});
  expect(refusalOf("a: [1"), {"is not YAML"});
  expect(refusalOf("- 1\n- 2\n"), {"no calibration"});
  expect(refusalOf(""), {"no calibration"});
  EXPECT_NE(
      messageOf<std::runtime_error>([] { readCalibration("/nowhere/at.yaml"); }).find("/nowhere/at.yaml"),
      std::string::npos);
  EXPECT_NE(refusalOf(std::string(1 << 17, '#')).find("too long"), std::string::npos);
}

// The other form that camera_calibration writes; with and without the line that it begins with.
TEST_F(CalibrationFile, OfTheFormIniIsToldHowToConvertIt) {
  const std::string ini =
      "\n[image]\n\nwidth\n640\n\nheight\n480\n\n[narrow_stereo]\n\ncamera matrix\n500.0 0.0 320.0\n";
  for (const std::string& text :
       {"# oST version 5.0 parameters\n\n" + ini, ini, std::string("# mine\n\n  [image]\r\nwidth 640")}) {
    expect(refusalOf(text), {"in the form .ini", "only that in YAML is read",
                             "rosrun camera_calibration_parsers convert cal.ini cal.yaml"});
  }
  for (const char* text : {"a: [1\n[2", "# a list\n- 1\n", "width\n640"})
    EXPECT_EQ(refusalOf(text).find(".ini"), std::string::npos) << text;
}

TEST_F(CalibrationFile, IsNotContradictedByWhatIsTypedBeside) {
  const Calibration read = readCalibration(kEuroc);
  const auto refusal = [&](const std::string& key, double value) {
    return messageOf([&] { requireAgreement(read, "euroc.yaml", {key, "--" + key, value}); });
  };
  EXPECT_EQ(refusal("width", 752), "");
  EXPECT_EQ(refusal("width", 640), "--width is 640, but must be 752 px as in euroc.yaml, or left out");
  EXPECT_EQ(refusal("height", 512), "--height is 512, but must be 480 px as in euroc.yaml, or left out");
  const double across = Lens(read.camera, read.distortion).acrossWidth().deg();
  EXPECT_EQ(refusal("horizontal_fov", across + 0.05), "");
  EXPECT_NE(refusal("horizontal_fov", 60.0).find("--horizontal_fov is 60, but must be "), std::string::npos);
}

TEST_F(CalibrationFile, OfAPinholeSaysTheSameInKAndP) {
  const Calibration made = calibrationOf({640, 480, 500.0, 501.0, 320.5, 239.5});
  EXPECT_TRUE(made.distortion.none());
  EXPECT_EQ(made.distortion.coefficients, std::vector<double>(5, 0.0));
  EXPECT_EQ(made.projection, (std::array<double, 12>{500.0, 0, 320.5, 0, 0, 501.0, 239.5, 0, 0, 0, 1, 0}));
}

}  // namespace
}  // namespace sunlit::image
