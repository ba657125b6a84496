#include "sunlit/evaluate/localise/odometry.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sunlit/evaluate/differences/feature_difference.h"
#include "sunlit/evaluate/features/detector.h"
#include "sunlit/evaluate/localise/odometry_runs.h"
#include "support/message_of.h"
#include "support/moody_detector.h"
#include "support/textured_scene.h"

namespace sunlit::evaluate {
namespace {

const image::PinholeCamera kCamera{320, 240, 277.0, 277.0, 159.5, 119.5};

/// Forward, and round a gentle bend.
std::vector<PosedView> drive() {
  static const std::vector<PosedView> views = [] {
    std::vector<PosedView> all;
    const TexturedScene scene = corridor();
    for (int i = 0; i < 8; ++i)
      all.push_back(scene.seenFrom(lookingAlongX({0.4 * i, 0.01 * i * i, 0.0}, 0.02 * i), kCamera));
    return all;
  }();
  return views;
}

Features featuresOf(const PosedView& view) {
  return detectFeatures(*makeDetector("sift"), view.picture);
}

TEST(Odometry, FollowsACameraToMillimetres) {
  Odometry odometry({cv::NORM_L2, true}, {});
  for (const PosedView& truth : drive()) {
    PosedView view = truth;
    if (odometry.keyFrames() > 0) view.map_from_optical = Eigen::Isometry3d::Identity();  // not to be used
    const Eigen::Isometry3d estimate = odometry.follow(view, featuresOf(view));
    // As a query in a map of the corridor, 6 mm each; of two or three key frames.
    EXPECT_LT((estimate.translation() - truth.map_from_optical.translation()).norm(), 0.018);
    EXPECT_LT(angleBetween(estimate, truth.map_from_optical), 0.005);
  }
  EXPECT_EQ(odometry.lost(), 0u);
  EXPECT_GE(odometry.keyFrames(), 2u);
  EXPECT_LT(odometry.keyFrames(), drive().size());
}

TEST(Odometry, GoesOnAsBeforeThroughAPictureOfNothing) {
  const std::vector<PosedView> views = drive();
  Odometry odometry({cv::NORM_L2, true}, {});
  odometry.follow(views[0], featuresOf(views[0]));
  const Eigen::Isometry3d first = odometry.follow(views[1], featuresOf(views[1]));
  const Eigen::Isometry3d moved = views[0].map_from_optical.inverse() * first;
  const Eigen::Isometry3d guessed = odometry.follow(views[2], {});
  EXPECT_EQ(odometry.lost(), 1u);
  EXPECT_TRUE(guessed.isApprox(first * moved, 1e-9));
}

TEST(Odometry, GoesOnThroughAPictureThatADetectorThrowsAt) {
  LocalisationOptions options;
  options.known.add("moody", makeFeatureDifference(moodyDetector()));
  options.detectors = {"sift", "moody"};
  std::vector<PosedView> views = drive();
  views[2].picture = makePicture(marked(views[2].picture.rgb));
  OdometryRuns runs(options);
  const FollowedViews followed = runs.follow(views);
  EXPECT_EQ(followed.faults, (DetectorFaults{{{2, 1}, std::string("moody: ") + kMood}}));
  for (const auto& poses : followed.poses) EXPECT_EQ(poses.size(), views.size());
  EXPECT_EQ(runs.at(0).lost(), 0u);
  EXPECT_GE(runs.at(1).lost(), 1u);
}

TEST(Odometry, NeedsDepth) {
  PosedView view = drive()[0];
  view.depth = cv::Mat();
  Odometry odometry({cv::NORM_L2, true}, {});
  EXPECT_EQ(messageOf([&] { odometry.follow(view, featuresOf(view)); }),
            "a view has no depth, but odometry needs it");
}

}  // namespace
}  // namespace sunlit::evaluate
