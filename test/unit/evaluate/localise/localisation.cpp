#include "sunlit/evaluate/localise/localisation.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "sunlit/evaluate/differences/feature_difference.h"
#include "support/message_of.h"
#include "support/moody_detector.h"
#include "support/textured_scene.h"

namespace sunlit::evaluate {
namespace {

const image::PinholeCamera kCamera{320, 240, 277.0, 277.0, 159.5, 119.5};

/// A drive along the corridor: key frames at x = 0, 1, 2.
std::vector<PosedView> drive() {
  static const std::vector<PosedView> views = [] {
    std::vector<PosedView> all;
    for (const double x : {0.0, 1.0, 2.0})
      all.push_back(corridor().seenFrom(lookingAlongX({x, 0, 0}), kCamera));
    return all;
  }();
  return views;
}

/// Off the line and turned.
PosedView query() {
  static const PosedView view = corridor().seenFrom(lookingAlongX({0.6, -0.4, 0.1}, 0.12), kCamera);
  return view;
}

LocalisationOptions both() {
  LocalisationOptions options;
  options.detectors = {"sift", "orb"};
  return options;
}

std::vector<LocalisedQuery> localised(const std::vector<PosedView>& map, const PosedView& view,
                                      const LocalisationOptions& options = both()) {
  Localisation localisation(options);
  localisation.addKeyFrames(map);
  localisation.finishMap();
  return localisation.localise({view}).results.at(0);
}

TEST(Localisation, FindsAQueryOffTheLineToMillimetres) {
  for (const Retrieval retrieval : {Retrieval::kTruth, Retrieval::kVlad, Retrieval::kAll}) {
    LocalisationOptions options = both();
    options.localiser.retrieval = retrieval;
    const std::vector<LocalisedQuery> results = localised(drive(), query(), options);
    ASSERT_EQ(results.size(), 2u);
    // Places of features are good to a tenth of a pixel (SIFT) or half of one (ORB), 277 px at some 6 m;
    // dozens of them are averaged.
    const double bounds_m[] = {0.006, 0.03};
    for (std::size_t d = 0; d < 2; ++d) {
      EXPECT_EQ(results[d].status, LocalisationStatus::kLocalised);
      EXPECT_LT(results[d].error_m, bounds_m[d]) << d;
      EXPECT_LT(results[d].error_deg, 0.2) << d;
      EXPECT_EQ(results[d].retrieved, 3u);
      EXPECT_GE(results[d].estimate.inliers.size(), 30u);
    }
  }
}

// As through a pinhole: what the lens moved by up to 30 px is moved back. Before the fisheye's picture pixels
// are coarser, 110 px to the radian.
TEST(Localisation, FindsAQueryThroughALens) {
  const ViewCamera barrel({320, 240, 195.0, 194.0, 156.0, 121.0},
                          {image::LensModel::kPlumbBob, {-0.283, 0.074, 2e-4, 2e-5}});
  const ViewCamera fisheye({320, 320, 110.0, 110.0, 159.0, 160.0},
                           {image::LensModel::kEquidistant, {0.0035, 0.0007, -0.002, 0.0002}});
  const double bounds_m[] = {0.01, 0.02};
  std::size_t bound = 0;
  for (const ViewCamera& camera : {barrel, fisheye}) {
    std::vector<PosedView> map;
    for (const double x : {0.0, 1.0, 2.0})
      map.push_back(corridor().seenFrom(lookingAlongX({x, 0, 0}), camera));
    const PosedView view = corridor().seenFrom(lookingAlongX({0.6, -0.4, 0.1}, 0.12), camera);
    const LocalisedQuery sift = localised(map, view)[0];
    EXPECT_EQ(sift.status, LocalisationStatus::kLocalised);
    EXPECT_LT(sift.error_m, bounds_m[bound]);
    EXPECT_LT(sift.error_deg, 0.2);
    // Taken for a pinhole, the same pictures lead astray.
    PosedView plain = view;
    plain.camera = image::PinholeCamera(camera);
    const LocalisedQuery wrong = localised(map, plain)[0];
    EXPECT_TRUE(wrong.status != LocalisationStatus::kLocalised || wrong.error_m > 5.0 * sift.error_m);
    ++bound;
  }
}

TEST(Localisation, StandsAnotherExposure) {
  PosedView dark = query();
  dark.picture = makePicture(dark.picture.rgb * 0.4);
  const LocalisedQuery result = localised(drive(), dark)[0];
  EXPECT_EQ(result.status, LocalisationStatus::kLocalised);
  EXPECT_LT(result.error_m, 0.02);
}

TEST(Localisation, GivesNoRightPoseFromAMapWhoseDepthIsWrong) {
  std::vector<PosedView> map = drive();
  for (PosedView& view : map) {
    view.depth = view.depth.clone();  // lest it be wrong in the tests that follow
    cv::Mat shuffled = view.depth.clone();
    cv::randShuffle(shuffled);
    const cv::Mat is_wrong = cv::abs(shuffled - view.depth) > 0.3 * view.depth;
    view.depth *= 2.0;  // what is right by chance
    shuffled.copyTo(view.depth, is_wrong);
  }
  // Directions stay right, so that a pose may be supported: but not the one where the query is.
  for (const LocalisedQuery& result : localised(map, query())) {
    EXPECT_TRUE(result.status == LocalisationStatus::kNoPose || result.error_m > 0.1);
  }
}

TEST(Localisation, GivesNoPoseToThePictureOfAnotherPlace) {
  PosedView mirrored = query();
  cv::Mat rgb;
  cv::flip(mirrored.picture.rgb, rgb, 1);
  mirrored.picture = makePicture(rgb);
  for (const LocalisedQuery& result : localised(drive(), mirrored)) {
    EXPECT_NE(result.status, LocalisationStatus::kLocalised);
    EXPECT_TRUE(std::isnan(result.error_m));
    EXPECT_TRUE(result.estimate.inliers.empty());
  }
}

TEST(Localisation, SaysWhyThereIsNoPose) {
  PosedView blank = query();
  blank.picture = makePicture(cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(90)));
  EXPECT_EQ(localised(drive(), blank)[0].status, LocalisationStatus::kNoFeatures);
  PosedView turned = query();
  turned.map_from_optical = lookingAlongX({0.6, 0, 0}, 3.1);
  EXPECT_EQ(localised(drive(), turned)[0].status, LocalisationStatus::kNotRetrieved);
  LocalisationOptions strict = both();
  strict.localiser.ratio_test.ratio = 0.01;
  EXPECT_EQ(localised(drive(), query(), strict)[0].status, LocalisationStatus::kTooFewMatches);
  strict = both();
  strict.localiser.pose.reprojection_px = 1e-3;
  EXPECT_EQ(localised(drive(), query(), strict)[0].status, LocalisationStatus::kNoPose);
}

TEST(Localisation, RetrievesTheNearestThatLookTheSameWay) {
  LocalisationOptions options = both();
  options.localiser.retrieved = 1;
  std::vector<PosedView> map = drive();
  // The nearest of all looks back.
  map.push_back(corridor().seenFrom(lookingAlongX({0.6, -0.4, 0.1}, 3.1), kCamera));
  const LocalisedQuery result = localised(map, query(), options)[0];
  EXPECT_EQ(result.status, LocalisationStatus::kLocalised);
  EXPECT_EQ(result.retrieved, 1u);
  EXPECT_EQ(result.key_frame, 1u);  // x = 1 is 0.58 m away, x = 0 0.73 m
}

TEST(Localisation, RetrievesByLooksAlone) {
  // Key frames of another corridor before and behind the right one; where the query is says nothing.
  const TexturedScene elsewhere(
      {{{12, 3, 3}, {0, -6, 0}, {0, 0, -4}, 11}, {{12, 3, -1}, {0, -6, 0}, {-16, 0, 0}, 14}});
  std::vector<PosedView> map;
  for (const double x : {0.5, 0.6, 0.7})
    map.push_back(elsewhere.seenFrom(lookingAlongX({x, -0.4, 0.1}), kCamera));
  map.insert(map.begin() + 1, drive()[0]);
  for (const Retrieval retrieval : {Retrieval::kVlad, Retrieval::kAll}) {
    LocalisationOptions options = both();
    options.localiser.retrieval = retrieval;
    options.localiser.retrieved = 1;
    for (const LocalisedQuery& result : localised(map, query(), options)) {
      EXPECT_EQ(result.retrieved, 1u);
      EXPECT_EQ(result.status, LocalisationStatus::kLocalised);
      EXPECT_EQ(result.key_frame, 1u);
    }
  }
}

TEST(Localisation, MeasuresDirectionsFromAKeyFrameThatIsApart) {
  // Key frames at 0, 1 and 2 m: from 2.0 the nearest one at least a metre away is that at 1 m.
  const PosedView view = corridor().seenFrom(lookingAlongX({2.0, 0, 0}), kCamera);
  const LocalisedQuery result = localised(drive(), view)[0];
  ASSERT_TRUE(result.has_baseline);
  // Off to the side by e, at 1 m, is atan(e); what is off along the line is none.
  EXPECT_LE(result.relative_deg, std::max(result.error_deg, std::atan(result.error_m) / kRadPerDeg) * 1.01);
  EXPECT_GE(result.relative_deg, result.error_deg);
  const LocalisedQuery alone = localised({drive()[0]}, drive()[0])[0];
  EXPECT_FALSE(alone.has_baseline);
  EXPECT_TRUE(std::isnan(alone.relative_deg));
  EXPECT_LT(alone.error_m, 1e-4);
}

TEST(Localisation, MeasuresDirectionsFromTheSameKeyFrameHoweverLengthsAreRounded) {
  // Key frames at 0 and 2 m; said to be taken midway, where rounding puts one or the other nearer, and one of
  // them less than a metre away. In truth it was taken 0.2 m further and 0.1 m to the side.
  const std::vector<PosedView> map{drive()[0], drive()[2]};
  PosedView view = corridor().seenFrom(lookingAlongX({1.2, 0.1, 0}), kCamera);
  for (const double off : {-1e-9, 0.0, 1e-9}) {
    view.map_from_optical = lookingAlongX({1.0 + off, 0, 0});
    for (const LocalisedQuery& result : localised(map, view)) {
      // By the first: 4.8 deg; by the other 7.1. A centimetre of error is half a degree.
      EXPECT_NEAR(result.relative_deg, std::atan2(0.1, 1.2) / kRadPerDeg, 0.5) << off;
    }
  }
  // A millimetre is no rounding.
  view.map_from_optical = lookingAlongX({0.999, 0, 0});
  EXPECT_FALSE(localised({drive()[0]}, view)[0].has_baseline);
}

TEST(Localisation, IsTheSameForAnyNumberOfThreads) {
  const auto run = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return localised(drive(), query());
  };
  const std::vector<LocalisedQuery> one = run(1);
  for (const std::size_t threads : {1, 2, 5}) {
    const std::vector<LocalisedQuery> other = run(threads);
    for (std::size_t d = 0; d < one.size(); ++d) {
      EXPECT_EQ(other[d].error_m, one[d].error_m);
      EXPECT_EQ(other[d].error_deg, one[d].error_deg);
      EXPECT_EQ(other[d].estimate.inliers, one[d].estimate.inliers);
      EXPECT_EQ(other[d].matches, one[d].matches);
    }
  }
}

PosedView at(PosedView view, cv::Mat (*change)(const cv::Mat&)) {
  view.picture = makePicture(change(view.picture.rgb));
  return view;
}

TEST(Localisation, GoesOnWithoutAPictureThatADetectorThrowsAt) {
  LocalisationOptions options;
  options.known.add("moody", makeFeatureDifference(moodyDetector()));
  options.detectors = {"moody", "orb"};
  const DetectorFaults of_second = {{{1, 0}, std::string("moody: ") + kMood}};
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Localisation localisation(options);
    EXPECT_EQ(localisation.addKeyFrames({drive()[0], at(drive()[1], marked), drive()[2]}).faults, of_second);
    localisation.finishMap();
    EXPECT_EQ(localisation.mapSizes()[0].key_frames, 2u);
    EXPECT_EQ(localisation.mapSizes()[1].key_frames, 3u);
    const LocalisedQueries found = localisation.localise({query(), at(query(), marked)});
    EXPECT_EQ(found.faults, of_second);
    EXPECT_EQ(found.results[0][0].status, LocalisationStatus::kLocalised);
    EXPECT_EQ(found.results[0][1].status, LocalisationStatus::kLocalised);
    EXPECT_EQ(found.results[1][1].status, LocalisationStatus::kLocalised);
  }
}

/// All but one blob: a picture of few features.
cv::Mat dark(const cv::Mat& rgb) {
  cv::Mat picture(rgb.size(), rgb.type(), cv::Scalar::all(0));
  const cv::Rect lit(120, 90, 45, 40);
  rgb(lit).copyTo(picture(lit));
  return picture;
}

TEST(Localisation, RetrievesByLooksInAMapInTheDark) {
  LocalisationOptions options = both();
  options.detectors = {"sift"};
  options.localiser.retrieval = Retrieval::kVlad;
  options.localiser.pose.min_inliers = 4;
  Localisation localisation(options);
  localisation.addKeyFrames({at(drive()[0], dark)});
  const MapSize size = localisation.mapSizes()[0];
  ASSERT_GT(size.points, 3u);
  ASSERT_LT(size.points, 64u);  // fewer than the usual words
  localisation.finishMap();
  EXPECT_EQ(localisation.localise({drive()[0]}).results[0][0].status, LocalisationStatus::kLocalised);
  // Of nothing at all nothing is retrieved.
  Localisation half_blind(options);
  PosedView black = drive()[0];
  black.picture = makePicture(cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(0)));
  const AddedKeyFrames added = half_blind.addKeyFrames({black, drive()[1]});
  EXPECT_TRUE(added.faults.empty());
  EXPECT_EQ(added.empty, (std::set<std::pair<std::size_t, std::size_t>>{{0, 0}})) << "black alone";
  Localisation blind(options);
  EXPECT_EQ(blind.addKeyFrames({black, black}).empty.size(), 2u);
  blind.finishMap();
  EXPECT_EQ(blind.localise({query()}).results[0][0].status, LocalisationStatus::kNotRetrieved);
}

TEST(Localisation, RefusesViewsAndOptionsThatDoNotDo) {
  Localisation localisation(both());
  std::vector<PosedView> map = drive();
  map[1].depth = cv::Mat();
  EXPECT_EQ(messageOf([&] { localisation.addKeyFrames(map); }), "a view has no depth, but a map needs it");
  EXPECT_EQ(localisation.mapSizes()[0].key_frames, 0u);
  EXPECT_EQ(localisation.localise({query()}).results[0][0].status, LocalisationStatus::kNotRetrieved);
  LocalisationOptions options = both();
  options.localiser.ratio_test.ratio = 1.5;
  EXPECT_EQ(messageOf([&] { Localisation none(options); }), "ratio is 1.5, but must be above 0 and up to 1");
  options = both();
  options.detectors = {"boolean_grey"};
  EXPECT_NE(messageOf([&] { Localisation none(options); }), "");
}

}  // namespace
}  // namespace sunlit::evaluate
