// Where the right camera of a pair stands is what the two files say, and files that are no pair are refused.
#include "sunlit/image/stereo.h"

#include <gtest/gtest.h>

#include <limits>

#include "sunlit/quantity/angle.h"
#include "support/message_of.h"

namespace sunlit::image {
namespace {

Calibration euroc(const std::string& name) {
  return readCalibration(SUNLIT_SOURCE_DIR "/test/support/cameras/" + name + ".yaml");
}

// T_BS of cam0 and cam1 in EuRoC's own sensor.yaml. The files of R and P are of ORB-SLAM, made of these by
// OpenCV and told of to 16 digits; T_BS to 12.
TEST(RightCamera, OfEurocStandsWhereTheDataSetSays) {
  Eigen::Matrix4d body_from_left, body_from_right;
  body_from_left << 0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,  //
      0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,                    //
      -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,                //
      0, 0, 0, 1;
  body_from_right << 0.0125552670891, -0.999755099723, 0.0182237714554, -0.0198435579556,  //
      0.999598781151, 0.0130119051815, 0.0251588363115, 0.0453689425024,                   //
      -0.0253898008918, 0.0179005838253, 0.999517347078, 0.00786212447038,                 //
      0, 0, 0, 1;
  const Eigen::Matrix4d expected = body_from_left.inverse() * body_from_right;
  const RightCamera right = calibratedRight(euroc("euroc"), euroc("euroc_right"), "");
  EXPECT_LT((right.left_from_right.matrix() - expected).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(right.calibration.camera.fx, 457.587);
  EXPECT_EQ(right.calibration.projection[3], -47.90639384423901);
  // 0.1101 m, and at 5 m 9.58 px.
  const double baseline_m = right.left_from_right.translation().norm();
  EXPECT_NEAR(baseline_m, 0.1101, 5e-5);
  EXPECT_NEAR(435.2046959714599 * baseline_m / 5.0, 9.58, 5e-3);
}

TEST(RightCamera, OfNoFileIsLikeTheLeftAndBesideIt) {
  const Calibration left = calibrationOf(PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0)));
  const RightCamera right = idealRight(left, 0.25, "");
  EXPECT_EQ(right.left_from_right.linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(right.left_from_right.translation(), Eigen::Vector3d(0.25, 0.0, 0.0));
  EXPECT_EQ(right.calibration.camera.fx, left.camera.fx);
  EXPECT_EQ(right.calibration.projection[3], -0.25 * left.camera.fx);
}

// Along the x of the rectified pictures, which is not that of the camera.
TEST(RightCamera, BesideARectifiedOneStandsWhereItIsRectifiedTo) {
  const Calibration left = euroc("euroc");
  const RightCamera right = idealRight(left, 0.1, "");
  for (int i = 0; i < 3; ++i)  // the first row of R; 1e-12: R itself is orthogonal to 1e-16
    EXPECT_NEAR(right.left_from_right.translation()[i], 0.1 * left.rectification[static_cast<std::size_t>(i)],
                1e-12);
  EXPECT_LT((right.left_from_right.linear() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(RightCamera, ThatIsOfNoPairIsRefused) {
  const Calibration left = euroc("euroc"), right = euroc("euroc_right");
  const auto refusal = [&](const Calibration& of_left, const Calibration& of_right) {
    return messageOf([&] { calibratedRight(of_left, of_right, "right.yaml: "); });
  };
  EXPECT_EQ(refusal(left, right), "");
  EXPECT_EQ(
      refusal(right, left),
      "right.yaml: projection_matrix[3] of the left is -47.90639384, but must be 0: is it the right one?");
  EXPECT_EQ(
      refusal(left, left),
      "right.yaml: the baseline -P[3] / P[0] of projection_matrix is 0, but must be above 0 and up to 100 m");
  const auto changed = [&](auto change) {
    Calibration other = right;
    change(&other);
    return refusal(left, other);
  };
  EXPECT_EQ(changed([](Calibration* c) { c->camera.width = 640; }),
            "right.yaml: image_width is 640, but must be 752 as of the left");
  EXPECT_EQ(changed([](Calibration* c) { c->camera.height = 400; }),
            "right.yaml: image_height is 400, but must be 480 as of the left");
  EXPECT_EQ(changed([](Calibration* c) { c->projection[0] = 400.0; }),
            "right.yaml: projection_matrix[0] is 400, but must be 435.204696 as of the left");
  EXPECT_NE(changed([](Calibration* c) { c->projection[7] = -40.0; }).find("projection_matrix[7] is -40"),
            std::string::npos);                                              // one above the other
  EXPECT_EQ(changed([](Calibration* c) { c->projection[2] += 20.0; }), "");  // they look at different places
  EXPECT_NE(changed([](Calibration* c) { c->projection[3] = 47.9; }).find("is -0.11006"), std::string::npos);
  // In mm: 110 m away.
  EXPECT_NE(changed([](Calibration* c) { c->projection[3] *= 1000.0; }).find("up to 100 m"),
            std::string::npos);
  EXPECT_NE(changed([](Calibration* c) { c->rectification[1] = 0.1; }).find("rectification_matrix is no rot"),
            std::string::npos);
  EXPECT_NE(changed([](Calibration* c) {
              for (double& r : c->rectification) r = -r;
            }).find("rectification_matrix is no rot"),
            std::string::npos);
  Calibration without = left;
  without.projection = {};
  EXPECT_NE(refusal(without, right).find("projection_matrix[0] of the left is 0"), std::string::npos);
  EXPECT_NE(messageOf([&] { idealRight(left, -1.0, "--baseline: "); }).find("is -1, but must be above 0"),
            std::string::npos);
}

}  // namespace
}  // namespace sunlit::image
